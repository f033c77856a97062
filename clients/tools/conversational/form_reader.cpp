#include <algorithm>
#include <cmath>

#include <fmt/ranges.h>
#include <toml++/toml.h>
#include <nlohmann/json.hpp>

#include "clients/tools/conversational/impl/form_reader.hpp"

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

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

/// Values of files may be long and hold anything; this shows enough to find them again.
std::string shown(const FileValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  constexpr std::size_t kMaxShown = 40;
  return fmt::format("\"{}\"", std::get<std::string>(value).substr(0, kMaxShown));
}

}  // namespace

const FileValue* FormReader::find(const Field& field) {
  known_.push_back(field.name);
  if (error_) return nullptr;
  const auto found = std::ranges::find(event_.fields, field.name, &FileField::name);
  if (found == event_.fields.end()) {
    if (field.is_required && field.applies) report("{} is missing", field.name);
    return nullptr;
  }
  if (!field.applies) {
    report("{} does not apply here ({})", field.name, field.condition);
    return nullptr;
  }
  return &found->value;
}

Entry FormReader::rounded(const Field& field, const TypedNumber& typed) {
  const Limits limits = limits_of(field, units_);
  if (!(typed.value >= limits.min && typed.value <= limits.max)) {
    report("{} = {:g} is not between {} and {}", field.name, typed.value, number_text(limits.min),
           number_text(limits.max));
    return std::nullopt;
  }
  const double scale = std::pow(10.0, limits.decimals);
  const double steps = std::round(typed.value * scale);
  constexpr double kNoise = 1e-4;  // of the last decimal, for the error of binary numbers
  if (!typed.is_fraction && std::abs(typed.value * scale - steps) > kNoise) {
    report("{} = {} has more than {} decimals", field.name, typed.value, limits.decimals);
    return std::nullopt;
  }
  return steps / scale;
}

Entry FormReader::number_of(const Field& field, const FileValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return rounded(field, {*number, false});
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) {
    report("{} = {}: expected a number", field.name, shown(value));
    return std::nullopt;
  }
  const auto typed = parse_entry(*text);
  if (typed) return rounded(field, *typed);
  report("{} = {}", field.name, typed.error().what);
  return std::nullopt;
}

void FormReader::number(const Field& field, Entry& entry) {
  if (const auto* value = find(field)) entry = number_of(field, *value);
}

void FormReader::whole(const Field& field, std::optional<int>& entry) {
  const auto* value = find(field);
  if (value == nullptr) return;
  if (const auto number = number_of(field, *value)) entry = static_cast<int>(*number);
}

void FormReader::text(const Field& field, std::string& entry) {
  const auto* value = find(field);
  if (value == nullptr) return;
  const auto* text = std::get_if<std::string>(value);
  if (text == nullptr) return report("{} = {}: expected a text", field.name, shown(*value));
  if (text->size() > static_cast<std::size_t>(field.max)) {
    return report("{} has {} characters, more than {}", field.name, text->size(), field.max);
  }
  for (const char c : *text) {
    if (c < ' ' || c > '~') {
      return report("{} has a character {:#04x}: only those of plain text can be posted",
                    field.name, static_cast<unsigned char>(c));
    }
  }
  const bool is_comment = field.quantity == Quantity::Comment;
  if (is_comment && text->find_first_of("()") != std::string::npos) {
    return report("{} = {}: no parentheses inside a comment", field.name, shown(*value));
  }
  entry = *text;
}

void FormReader::feedrate(const Field& field, Feedrate& entry) {
  const auto* value = find(field);
  if (value == nullptr) return;
  const auto* text = std::get_if<std::string>(value);
  entry = {};
  entry.is_rapid = text != nullptr && lower(*text) == "rapid";
  if (!entry.is_rapid) entry.value = number_of(field, *value);
}

void FormReader::choice(const Field& field, std::span<const std::string_view> names,
                        std::size_t& index) {
  const auto* value = find(field);
  if (value == nullptr) return;
  std::string wanted;
  if (const auto* text = std::get_if<std::string>(value)) wanted = lower(*text);
  if (const auto* flag = std::get_if<bool>(value)) wanted = *flag ? "yes" : "no";
  if (const auto* number = std::get_if<double>(value)) wanted = fmt::format("{:g}", *number);
  const auto found = std::ranges::find(names, wanted);
  if (found == names.end()) {
    return report("{} = {}: expected one of {}", field.name, shown(*value), fmt::join(names, ", "));
  }
  index = static_cast<std::size_t>(found - names.begin());
}

void FormReader::demand(bool holds, std::string_view text) {
  if (!holds) report("{}", text);
}

void FormReader::finish() {
  for (const auto& field : event_.fields) {
    if (field.name == "type" || std::ranges::count(known_, field.name) > 0) continue;
    report("{} is not a field here; known are {}", field.name.substr(0, 40),
           fmt::join(known_, ", "));
  }
}

}  // namespace dripline::conversational
