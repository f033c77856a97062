#include <toml++/toml.h>

#include "clients/tools/conversational/impl/document.hpp"

namespace dripline::conversational {
namespace {

unsigned line_of(const toml::node& node) {
  return static_cast<unsigned>(node.source().begin.line);
}

Result<FileValue> value_of(const toml::key& key, const toml::node& node) {
  if (const auto* text = node.as_string()) return FileValue(text->get());
  if (const auto* flag = node.as_boolean()) return FileValue(flag->get());
  if (const auto* whole = node.as_integer()) return FileValue(static_cast<double>(whole->get()));
  if (const auto* number = node.as_floating_point()) return FileValue(number->get());
  return fail(Errc::Syntax, "line {}: {}: {}", line_of(node), key.str(), kShape);
}

Result<FileEvent> event_of(const toml::node& node) {
  const auto* table = node.as_table();
  if (table == nullptr) return fail(Errc::Syntax, "line {}: {}", line_of(node), kShape);
  FileEvent event;
  event.line = static_cast<int>(line_of(node));
  for (const auto& [key, field] : *table) {
    auto value = value_of(key, field);
    if (!value) return fail(value.error());
    event.fields.push_back({std::string(key.str()), *std::move(value)});
  }
  return event;
}

Result<std::vector<FileEvent>> events_of(const toml::table& file) {
  std::vector<FileEvent> events;
  for (const auto& [key, node] : file) {
    const auto* list = node.as_array();
    if (key.str() != "event" || list == nullptr) {
      return fail(Errc::Syntax, "line {}: {}: {}", line_of(node), key.str(), kShape);
    }
    if (list->size() > kMaxEvents) {
      return fail(Errc::LimitExceeded, "{} events are more than {}", list->size(), kMaxEvents);
    }
    for (const auto& element : *list) {
      auto event = event_of(element);
      if (!event) return fail(event.error());
      events.push_back(*std::move(event));
    }
  }
  return events;
}

}  // namespace

Result<std::vector<FileEvent>> read_toml(std::string_view text) {
  try {
    return events_of(toml::parse(text));
  } catch (const toml::parse_error& e) {
    return fail(Errc::Syntax, "line {}: {}", e.source().begin.line, e.description());
  }
}

}  // namespace dripline::conversational
