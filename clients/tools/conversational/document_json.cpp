#include <nlohmann/json.hpp>

#include "clients/tools/conversational/impl/document.hpp"

namespace dripline::conversational {
namespace {

using Json = nlohmann::ordered_json;

Result<FileEvent> event_of(const Json& object, std::size_t number) {
  if (!object.is_object()) return fail(Errc::Syntax, "event {}: {}", number, kShape);
  FileEvent event;
  for (const auto& [key, value] : object.items()) {
    if (value.is_string()) {
      event.fields.push_back({key, value.get<std::string>()});
    } else if (value.is_boolean()) {
      event.fields.push_back({key, value.get<bool>()});
    } else if (value.is_number()) {
      event.fields.push_back({key, value.get<double>()});
    } else if (!value.is_null()) {  // null: left blank
      return fail(Errc::Syntax, "event {}: {}: {}", number, key, kShape);
    }
  }
  return event;
}

/// No value of such a file is deeper; deeper files are not read into memory.
Json parse(std::string_view text) {
  constexpr int kDeepest = 4;
  bool is_too_deep = false;
  const auto guard = [&](int depth, Json::parse_event_t, Json&) {
    is_too_deep = is_too_deep || depth > kDeepest;
    return !is_too_deep;
  };
  return Json::parse(text, guard, false);
}

}  // namespace

Result<std::vector<FileEvent>> read_json(std::string_view text) {
  const Json file = parse(text);
  const bool has_events =
      file.is_object() && file.size() == 1 && file.contains("event") && file["event"].is_array();
  if (!has_events)
    return fail(Errc::Syntax, "expected {{\"event\": [{{\"type\": ...}}, ...]}} in JSON");
  const Json& list = file["event"];
  if (list.size() > kMaxEvents) {
    return fail(Errc::LimitExceeded, "{} events are more than {}", list.size(), kMaxEvents);
  }
  std::vector<FileEvent> events;
  for (const Json& object : list) {
    auto event = event_of(object, events.size());
    if (!event) return fail(event.error());
    events.push_back(*std::move(event));
  }
  return events;
}

}  // namespace dripline::conversational
