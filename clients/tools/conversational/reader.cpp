#include "clients/tools/conversational/reader.hpp"

#include <algorithm>

#include "clients/tools/conversational/fields.hpp"
#include "clients/tools/conversational/impl/form_reader.hpp"

namespace dripline::conversational {
namespace {

Result<std::vector<FileEvent>> read_document(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string_view::npos && text[first] == '{';
  return is_json ? read_json(text) : read_toml(text);
}

std::string place_of(const FileEvent& event, std::size_t number, std::string_view type) {
  std::string place = fmt::format("event {}", number);
  if (!type.empty()) place += fmt::format(" ({})", type);
  if (event.line > 0) place += fmt::format(", line {}", event.line);
  return place;
}

Result<const EventKind*> kind_of(const FileEvent& event, std::size_t number) {
  const auto type = std::ranges::find(event.fields, "type", &FileField::name);
  const auto* name = type == event.fields.end() ? nullptr : std::get_if<std::string>(&type->value);
  if (name == nullptr) {
    return fail(Errc::Syntax, "{}: type = \"...\" is missing", place_of(event, number, ""));
  }
  if (const auto* kind = find_event_kind(*name)) return kind;
  return fail(Errc::Syntax, "{}: type = \"{}\" is not an event", place_of(event, number, ""),
              name->substr(0, 40));
}

Result<Event> read_event(const FileEvent& file, std::size_t number, UnitSystem& units) {
  const auto kind = kind_of(file, number);
  if (!kind) return fail(kind.error());
  Event event = (*kind)->blank;
  FormReader form(file, units);
  walk_fields(form, event);
  form.finish();
  if (form.error()) {
    return fail(Errc::Syntax, "{}: {}", place_of(file, number, (*kind)->type), *form.error());
  }
  units = form.units();
  return event;
}

}  // namespace

Result<Events> read_events(std::string_view text) {
  if (text.size() > kMaxFile) {
    return fail(Errc::LimitExceeded, "the file has {} bytes, more than {}", text.size(), kMaxFile);
  }
  const auto document = read_document(text);
  if (!document) {
    return fail(document.error().code, "{} (centurion error 305: not formatted for conversational)",
                document.error().what);
  }
  Events events;
  UnitSystem units = UnitSystem::English;
  for (const auto& file_event : *document) {
    auto event = read_event(file_event, events.size(), units);
    if (!event) return fail(event.error());
    events.push_back(*std::move(event));
  }
  return events;
}

}  // namespace dripline::conversational
