#include "clients/tools/conversational/event_file.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "clients/tools/conversational/impl/form_reader.hpp"
#include "clients/tools/conversational/post.hpp"
#include "clients/tools/conversational/reader.hpp"
#include "protocol/base/lines.hpp"

namespace dripline::conversational {
namespace {

constexpr std::string_view kHeader = "[[event]]";

std::string_view bare(std::string_view text) {
  return trimmed(text, " \t\r\n");
}

/// A file cut at its events: `starts` are lines, the last entry is the number of all lines.
struct CutFile {
  std::vector<std::string_view> lines;  ///< with their ends
  std::vector<FileEvent> events;
  std::vector<std::size_t> starts;

  std::string text(std::size_t first, std::size_t last) const {
    std::string joined;
    for (std::size_t i = first; i < last; ++i) joined += lines[i];
    return joined;
  }
};

/// The first of the comment lines directly above the header of event `line`.
std::size_t section_start(const CutFile& cut, std::size_t line) {
  while (line > 0 && bare(cut.lines[line - 1]).starts_with('#')) --line;
  return line;
}

Result<CutFile> cut_file(std::string_view file) {
  if (file.size() > kMaxFile) {
    return fail(Errc::LimitExceeded, "the file has {} bytes, more than {}", file.size(), kMaxFile);
  }
  if (bare(file).starts_with('{')) {
    return fail(Errc::Unsupported, "events of a JSON file are not edited: expected TOML");
  }
  auto events = read_toml(file);
  if (!events) return fail(events.error());
  CutFile cut{lines_with_ends(file), *std::move(events), {}};
  std::size_t lowest = 0;  // two events of one line are no tables of their own
  for (std::size_t number = 0; number < cut.events.size(); ++number) {
    const auto line = static_cast<std::size_t>(cut.events[number].line);
    if (line <= lowest || line > cut.lines.size() ||
        !trimmed(cut.lines[line - 1]).starts_with(kHeader)) {
      return fail(Errc::Unsupported, "event {}, line {}: expected {} on a line of its own", number,
                  line, kHeader);
    }
    lowest = line;
    cut.starts.push_back(section_start(cut, line - 1));
  }
  cut.starts.push_back(cut.lines.size());
  return cut;
}

Result<void> check_number(const CutFile& cut, std::size_t number) {
  if (number < cut.events.size()) return {};
  if (cut.events.empty()) return fail(Errc::NotFound, "event {}: the file has none", number);
  return fail(Errc::NotFound, "event {} is not there: the file has events 0 to {}", number,
              cut.events.size() - 1);
}

std::string type_of(const FileEvent& event) {
  const auto type = std::ranges::find(event.fields, "type", &FileField::name);
  const auto* name = type == event.fields.end() ? nullptr : std::get_if<std::string>(&type->value);
  return name == nullptr ? "" : *name;
}

std::optional<int> tool_of(const FileEvent& event) {
  const auto tool = std::ranges::find(event.fields, "tool", &FileField::name);
  const auto* number = tool == event.fields.end() ? nullptr : std::get_if<double>(&tool->value);
  if (number == nullptr || !(*number >= 0 && *number <= 9999)) return std::nullopt;
  return static_cast<int>(*number);
}

/// Without a comment after the value; a # within quotes is part of the value.
std::string_view without_comment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote == 0 && line[i] == '#') return line.substr(0, i);
    if (quote == '"' && line[i] == '\\') {
      ++i;
    } else if (quote == 0 && (line[i] == '"' || line[i] == '\'')) {
      quote = line[i];
    } else if (line[i] == quote) {
      quote = 0;
    }
  }
  return line;
}

std::string fields_of(const CutFile& cut, std::size_t number) {
  std::string fields;
  for (auto i = static_cast<std::size_t>(cut.events[number].line); i < cut.starts[number + 1];
       ++i) {
    const auto field = bare(without_comment(cut.lines[i]));
    if (field.empty() || bare(field.substr(0, field.find('='))) == "type") continue;
    fields += (fields.empty() ? "" : ", ") + std::string(field);
  }
  return fields;
}

bool has_text(std::string_view text, std::string_view wanted) {
  const auto lower = [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  };
  const auto is_same = [&](char left, char right) { return lower(left) == lower(right); };
  return wanted.empty() ||
         std::search(text.begin(), text.end(), wanted.begin(), wanted.end(), is_same) != text.end();
}

/// Why a file is not posted.
std::optional<std::string> posting_fault(std::string_view file) {
  const auto events = read_events(file);
  if (!events) return events.error().what;
  const auto posted = post(*events);
  if (!posted) return posted.error().what;
  return std::nullopt;
}

}  // namespace

Result<std::vector<ListedEvent>> list_events(std::string_view file, const EventQuery& query) {
  const auto cut = cut_file(file);
  if (!cut) return fail(cut.error());
  std::vector<ListedEvent> listed;
  for (std::size_t number = 0; number < cut->events.size(); ++number) {
    ListedEvent event{number, type_of(cut->events[number]), cut->events[number].line,
                      fields_of(*cut, number)};
    if (!query.type.empty() && event.type != query.type) continue;
    if (query.tool && tool_of(cut->events[number]) != query.tool) continue;
    if (has_text(event.fields, query.text)) listed.push_back(std::move(event));
  }
  return listed;
}

Result<std::string> delete_events(std::string_view file, std::size_t first, std::size_t last) {
  const auto cut = cut_file(file);
  if (!cut) return fail(cut.error());
  if (last < first)
    return fail(Errc::Syntax, "events {}..{}: the range runs backwards", first, last);
  for (const std::size_t number : {first, last}) {
    if (auto checked = check_number(*cut, number); !checked) return fail(checked.error());
  }
  if (first == 0 || last + 1 == cut->events.size()) {
    return fail(Errc::Conflict, "event {} is the program's {}: it is changed, not deleted",
                first == 0 ? first : last, first == 0 ? "first" : "last");
  }
  std::string text =
      cut->text(0, cut->starts[first]) + cut->text(cut->starts[last + 1], cut->lines.size());
  if (!posting_fault(file)) {
    if (const auto fault = posting_fault(text)) {
      return fail(Errc::Conflict,
                  "without {} the file could not be posted: {} (numbered as it then is)",
                  first == last ? fmt::format("event {}", first)
                                : fmt::format("events {} to {}", first, last),
                  *fault);
    }
  }
  return text;
}

Result<std::string> insert_events(std::string_view file, std::size_t before,
                                  std::string_view inserted) {
  const auto cut = cut_file(file);
  if (!cut) return fail(cut.error());
  if (auto checked = check_number(*cut, before); !checked) return fail(checked.error());
  if (before == 0) {
    return fail(Errc::Conflict, "event 0 is the program's set-up: nothing is inserted before it");
  }
  const auto added = cut_file(inserted);
  if (!added) return fail(added.error().code, "the events to insert: {}", added.error().what);
  if (added->events.empty()) return fail(Errc::Syntax, "there are no events to insert");
  const std::size_t place = cut->starts[before];
  std::string text = cut->text(0, place);
  if (!text.ends_with('\n')) text += '\n';
  text += inserted;
  if (!text.ends_with('\n')) text += '\n';
  text += '\n' + cut->text(place, cut->lines.size());
  if (const auto events = read_events(text); !events) return fail(events.error());
  return text;
}

}  // namespace dripline::conversational
