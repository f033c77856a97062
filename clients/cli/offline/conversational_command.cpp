#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/event_editing.hpp"
#include "clients/cli/port/port_file.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/tools/conversational/catalog.hpp"
#include "clients/tools/conversational/post.hpp"
#include "clients/tools/conversational/reader.hpp"

namespace dripline::cli {
namespace {

using conversational::EventDescription;
using conversational::FieldDescription;
using conversational::FieldKind;
using nlohmann::ordered_json;

struct ConversationalCommand {
  std::string file, output, event;
  int program = 1;
  bool has_printed_crest_formula = false;
};

int post(const ConversationalCommand& command) {
  const auto text = read_small_file(command.file, conversational::kMaxFile);
  if (!text) {
    complain(text.error());
    return kExitUsage;
  }
  const auto events = conversational::read_events(*text);
  const auto posted = events ? conversational::post(*events, {command.has_printed_crest_formula})
                             : Result<std::string>(fail(events.error()));
  if (posted) return write_to(command.output, *posted);
  complain(Error{posted.error().code, command.file + ": " + posted.error().what});
  return kExitNo;
}

ordered_json limits_json(const conversational::Limits& limits) {
  return {{"min", limits.min}, {"max", limits.max}, {"decimals", limits.decimals}};
}

ordered_json field_json(const FieldDescription& field) {
  ordered_json json{{"name", field.name},
                    {"kind", to_string(field.kind)},
                    {"word", field.word},
                    {"help", field.help},
                    {"required", field.is_required}};
  if (!field.condition.empty()) json["condition"] = field.condition;
  if (field.kind == FieldKind::Choice) {
    json["choices"] = field.choices;
  } else if (field.kind == FieldKind::Text) {
    json["max_characters"] = field.english.max;
  } else {
    json["english"] = limits_json(field.english);
    json["metric"] = limits_json(field.metric);
  }
  if (!field.blank.empty()) json["default"] = field.blank;
  return json;
}

std::string events_json(const std::vector<EventDescription>& events) {
  auto list = ordered_json::array();
  for (const auto& event : events) {
    auto fields = ordered_json::array();
    for (const auto& field : event.fields) fields.push_back(field_json(field));
    list.push_back({{"type", event.type},
                    {"title", event.title},
                    {"fields", std::move(fields)},
                    {"rules", event.rules}});
  }
  return json_text(ordered_json{{"events", std::move(list)}});
}

std::string values_text(const FieldDescription& field) {
  if (field.kind == FieldKind::Choice) return fmt::format("{}", fmt::join(field.choices, " | "));
  if (field.kind == FieldKind::Text) return "text";
  const auto& limits = field.english;
  const std::string range = fmt::format("{} to {}", conversational::number_text(limits.min),
                                        conversational::number_text(limits.max));
  return field.kind == FieldKind::Feedrate ? "rapid | " + range : range;
}

std::string default_text(const FieldDescription& field) {
  return field.is_required ? "required" : field.blank;
}

std::string event_text(const EventDescription& event, bool has_color) {
  std::string text = fmt::format("{}  ({})\n", event.type, event.title);
  if (event.fields.empty()) return text + "  no fields\n";
  Table table({"FIELD", "WORD", "VALUES", "DEFAULT", "ONLY WITH", "MEANING"});
  for (const auto& field : event.fields) {
    table.add({field.name, field.word, values_text(field), default_text(field), field.condition,
               field.help});
  }
  text += table.render(has_color);
  for (const auto& rule : event.rules) text += "  " + rule + "\n";
  return text;
}

int list_events(Context& context, const ConversationalCommand& command) {
  auto events = conversational::describe_events();
  if (!command.event.empty()) {
    std::erase_if(events, [&](const auto& event) { return event.type != command.event; });
  }
  if (events.empty()) {
    complain(Error{Errc::NotFound, fmt::format("there is no event '{}'", command.event)});
    return kExitUsage;
  }
  if (context.wants_json) {
    context.print(events_json(events));
    return kExitOk;
  }
  std::string text;
  for (const auto& event : events) {
    text += (text.empty() ? "" : "\n") + event_text(event, context.has_color());
  }
  context.print(text);
  return kExitOk;
}

using ConversationalOptions = std::shared_ptr<ConversationalCommand>;

void add_post(Command group, Context& context, const ConversationalOptions& options) {
  auto post_verb = group.add_subcommand("post", "Post an event file as program text");
  post_verb.add_option("FILE", options->file, "TOML with [[event]] tables, or the same as JSON")
      .required();
  post_verb.add_option("-o,--output", options->output,
                       "File to write [standard output]; it is written whole or not at all");
  post_verb.add_flag("--printed-crest-formula", options->has_printed_crest_formula,
                     "Use the manual's printed formula for threads given by their crest, although "
                     "its geometry is wrong");
  post_verb.callback([&context, options] { context.status = post(*options); });
}

void add_events(Command group, Context& context, const ConversationalOptions& options) {
  auto events = group.add_subcommand("events", "List the events with their fields and limits");
  events.add_option("TYPE", options->event, "List only this event, e.g. drill");
  add_json_flag(events, context);
  events.footer("Limits are those of inch programs; --json has both.");
  events.callback([&context, options] { context.status = list_events(context, *options); });
}

void add_new(Command group, Context& context, const ConversationalOptions& options) {
  auto starter = group.add_subcommand("new", "Write a small job with comments, to start from");
  starter.add_option("--program", options->program, "O number of the program [1]")
      .check(in_range(1, 9999));
  starter.add_option("-o,--output", options->output, "File to write [standard output]");
  starter.callback([&context, options] {
    context.status = write_to(options->output, conversational::starter_file(options->program));
  });
}

}  // namespace

void add_conversational_commands(Command app, Context& context) {
  auto group = app.add_subcommand(
      "conversational", "Make programs from events, as the screens of the Centurion lathe do");
  group.require_subcommand(1);
  const auto options = std::make_shared<ConversationalCommand>();
  add_post(group, context, options);
  add_events(group, context, options);
  add_new(group, context, options);
  add_event_editing(group, context);
  group.footer(
      "Example:\n  dnc conversational new --program 400 -o pin.toml\n"
      "  dnc conversational post pin.toml -o O0400\n  dnc check --control centurion O0400");
}

}  // namespace dripline::cli
