#include "clients/cli/offline/event_editing.hpp"

#include <fmt/format.h>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/port/port_file.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/tools/conversational/event_file.hpp"
#include "clients/tools/conversational/reader.hpp"

namespace dripline::cli {
namespace {

using EventRange = std::pair<std::size_t, std::size_t>;

struct EventEditing {
  std::string file, output, events, text, from;
  std::size_t before = 0;
  conversational::EventQuery query;
};

Result<std::string> read_event_file(const std::string& file) {
  return read_small_file(file, conversational::kMaxFile);
}

/// "7", or "5..7". Errors: Syntax.
Result<EventRange> event_range_of(std::string_view text) {
  const char* const end = text.data() + text.size();
  std::uint16_t first = 0, last = 0;
  const auto read = std::from_chars(text.data(), end, first);
  if (read.ec == std::errc{} && read.ptr == end) return EventRange(first, first);
  const auto rest = text.substr(static_cast<std::size_t>(read.ptr - text.data()));
  if (read.ec == std::errc{} && rest.starts_with("..")) {
    const auto second = std::from_chars(read.ptr + 2, end, last);
    if (second.ec == std::errc{} && second.ptr == end) return EventRange(first, last);
  }
  return fail(Errc::Syntax, "'{}' names no events: expected a number as 7, or several as 5..7",
              text);
}

int list_file_events(Context& context, const EventEditing& command) {
  const auto text = read_event_file(command.file);
  if (!text) return complain(text.error()), kExitUsage;
  const auto events = conversational::list_events(*text, command.query);
  if (!events) {
    complain(Error{events.error().code, command.file + ": " + events.error().what});
    return kExitNo;
  }
  if (context.wants_json) {
    auto json = nlohmann::ordered_json::array();
    for (const auto& event : *events) {
      json.push_back({{"event", event.number},
                      {"type", event.type},
                      {"line", event.line},
                      {"fields", event.fields}});
    }
    context.print(json_text(nlohmann::ordered_json{{"events", std::move(json)}}));
    return kExitOk;
  }
  if (events->empty()) return context.print("No event matches.\n"), kExitOk;
  Table table({"EVENT", "LINE", "TYPE", "FIELDS"});
  for (const auto& event : *events) {
    table.add(
        {fmt::format("{}", event.number), fmt::format("{}", event.line), event.type, event.fields});
  }
  context.print(table.render(context.has_color()));
  return kExitOk;
}

int save_events(const EventEditing& command, const Result<std::string>& edited) {
  if (!edited) {
    complain(Error{edited.error().code, command.file + ": " + edited.error().what});
    return kExitNo;
  }
  return write_to(command.output.empty() ? command.file : command.output, *edited);
}

int delete_file_events(const EventEditing& command) {
  const auto range = event_range_of(command.events);
  if (!range) return complain(range.error()), kExitUsage;
  const auto text = read_event_file(command.file);
  if (!text) return complain(text.error()), kExitUsage;
  return save_events(command, conversational::delete_events(*text, range->first, range->second));
}

int insert_file_events(const EventEditing& command) {
  if (command.text.empty() == command.from.empty()) {
    return complain(Error{Errc::Syntax, "expected --text or --from, and not both"}), kExitUsage;
  }
  const auto inserted =
      command.from.empty() ? Result<std::string>(command.text) : read_event_file(command.from);
  if (!inserted) return complain(inserted.error()), kExitUsage;
  const auto text = read_event_file(command.file);
  if (!text) return complain(text.error()), kExitUsage;
  return save_events(command, conversational::insert_events(*text, command.before, *inserted));
}

using EditingOptions = std::shared_ptr<EventEditing>;

void add_event_file(Command verb, const EditingOptions& options) {
  verb.add_option("FILE", options->file, "TOML with [[event]] tables").required();
}

void add_event_output(Command verb, const EditingOptions& options) {
  verb.add_option("-o,--output", options->output, "Write to this file, not in place");
}

}  // namespace

void add_event_editing(Command group, Context& context) {
  const auto options = std::make_shared<EventEditing>();
  auto lister = group.add_subcommand("list", "List a file's events, or search them");
  add_event_file(lister, options);
  lister.add_option("--type", options->query.type, "List events of this type only, e.g. drill");
  lister.add_option("--tool", options->query.tool, "List changes and calls of this tool only");
  lister.add_option("--find", options->query.text,
                    "List events with this text in their fields only, in any case");
  add_json_flag(lister, context);
  lister.callback([&context, options] { context.status = list_file_events(context, *options); });

  auto deleter = group.add_subcommand("delete", "Delete events of a file");
  add_event_file(deleter, options);
  deleter.add_option("EVENTS", options->events, "Numbers as listed: 7, or 5..7").required();
  add_event_output(deleter, options);
  deleter.callback([&context, options] { context.status = delete_file_events(*options); });

  auto inserter = group.add_subcommand("insert", "Insert events before one of a file");
  add_event_file(inserter, options);
  inserter.add_option("--before", options->before, "Number of that event, as listed").required();
  inserter.add_option("--text", options->text, "[[event]] tables to insert");
  inserter.add_option("--from", options->from, "File with the tables to insert");
  add_event_output(inserter, options);
  inserter.footer(
      "The whole result is checked; a file with a faulty event is left as it is. As at the "
      "control,\n"
      "nothing is inserted before the first event, and the first and last are not deleted.");
  inserter.callback([&context, options] { context.status = insert_file_events(*options); });
}

}  // namespace dripline::cli
