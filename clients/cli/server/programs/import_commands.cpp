#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/comparison_text.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;

struct ImportList {
  bool decided = false;
};

struct ImportChoice {
  std::string program;
  std::uint64_t revision = 0;
  std::string target, comment;
};

std::string class_words(const std::string& word) {
  std::string words = printable(word);
  std::ranges::replace(words, '_', ' ');
  return words;
}

std::string outcome_text(const client::Import& import) {
  if (const auto& target = import.accepted_as)
    return fmt::format("accepted as {} revision {}", printable(target->program), target->revision);
  return import.at_once ? "accepted at once" : class_words(import.state);
}

Table pending_table(const std::vector<client::Import>& imports) {
  Table table({"PROGRAM", right("REV"), "MACHINE", "CLASS", right("AGAINST"), right("SIZE"),
               "RECEIVED", "COMMENT"});
  for (const auto& import : imports) {
    table.add({printable(import.program), std::to_string(import.revision),
               printable(import.machine),
               import.edit.empty() ? Cell("unknown", Style::Busy) : Cell(class_words(import.edit)),
               import.base ? std::to_string(*import.base) : "-", bytes_text(import.size),
               time_text(import.received), printable(import.comment)});
  }
  return table;
}

Table decided_table(const std::vector<client::Import>& imports) {
  Table table({"PROGRAM", right("REV"), "MACHINE", "CLASS", "DECISION", "TIME", "WHO", "REASON"});
  for (const auto& import : imports) {
    table.add({printable(import.program), std::to_string(import.revision),
               printable(import.machine), class_words(import.edit), outcome_text(import),
               time_text(import.decided), printable(import.who), printable(import.reason)});
  }
  return table;
}

int list_imports(Context& context, client::Client& client, const ImportList& command) {
  auto imports =
      fetch_all(0, [&](client::Page page) { return client.imports(!command.decided, page); });
  if (const auto status = finished(context, imports, "imports")) return *status;
  if (imports->empty()) {
    context.print(command.decided ? "Nothing from a machine was decided yet.\n"
                                  : "No program from a machine waits.\n");
    return kExitOk;
  }
  context.print(command.decided ? decided_table(*imports) : pending_table(*imports));
  return kExitOk;
}

void print_import(const Context& context, const ordered_json& shown) {
  const std::string program = text_at(shown, "program");
  const auto revision = shown.at("revision").get<std::uint64_t>();
  Details details;
  details.add("program", fmt::format("{} revision {}", printable(program), revision));
  details.add("machine", printable(text_at(shown, "machine")));
  details.add("received", time_text(text_at(shown, "received")));
  details.add("state", class_words(text_at(shown, "state")));
  const std::string edit = text_at(shown, "class");
  details.add("class", edit.empty() ? "unknown" : class_words(edit));
  for (const char* key : {"comment", "fault", "who", "reason"}) {
    if (const auto text = text_at(shown, key); !text.empty()) details.add(key, printable(text));
  }
  context.print(details);
  if (const auto fault = text_at(shown, "comparison_fault"); !fault.empty())
    context.print(fmt::format("\nNot compared by motion: {}\n", printable(fault)));
  if (!shown.contains("comparison")) return;
  const ComparedNames names{
      fmt::format("{}@{}", program, shown.at("compared_with").get<std::uint64_t>()),
      fmt::format("{}@{}", program, revision)};
  context.print("\n");
  context.print(comparison_text(shown.at("comparison"), names, context.has_color()));
}

int show_import(Context& context, client::Client& client, const ImportChoice& command) {
  return print_answer(context, client, client.import(command.program, command.revision),
                      [&](const ordered_json& shown) { print_import(context, shown); });
}

int accept_import(Context& context, client::Client& client, const ImportChoice& command) {
  auto accepted = client.accept_import({.program = command.program,
                                        .revision = command.revision,
                                        .target = command.target,
                                        .comment = command.comment});
  if (const auto status = finished(context, accepted)) return *status;
  context.print(fmt::format("Accepted {} revision {}: {}, sha256 {}\n", accepted->program,
                            accepted->revision, bytes_text(accepted->size),
                            short_id(accepted->sha256)));
  return kExitOk;
}

int reject_import(Context& context, client::Client& client, const ImportChoice& command) {
  const auto rejected = client.reject_import(
      {.program = command.program, .revision = command.revision, .comment = command.comment});
  if (!rejected) return complain(rejected.error());
  if (context.wants_json) {
    context.print(json_text(ordered_json{
        {"program", command.program}, {"revision", command.revision}, {"state", "rejected"}}));
    return kExitOk;
  }
  context.print(fmt::format("Rejected {} revision {}; it is hidden and will never run.\n",
                            command.program, command.revision));
  return kExitOk;
}

void add_choice(Command command, const std::shared_ptr<ImportChoice>& options) {
  command.add_option("NAME", options->program, "The program").required();
  command.add_option("REV", options->revision, "Its revision").required();
}

}  // namespace

void add_import_commands(Command app, Context& context) {
  auto group = app.add_subcommand("import", "Programs that machines sent: compare, accept, reject");
  group.require_subcommand(1);

  auto list = group.add_subcommand("list", "List what waits, oldest first");
  auto list_options = std::make_shared<ImportList>();
  list.add_flag("--decided", list_options->decided,
                "List what was accepted and rejected instead, latest first");
  add_json_flag(list, context);
  run_at_server(list, context, list_options, list_imports);

  auto show = group.add_subcommand("show", "Show what a revision changes, with both lines");
  auto show_options = std::make_shared<ImportChoice>();
  add_choice(show, show_options);
  add_json_flag(show, context);
  show.footer(
      "It is compared with the released revision, or without one with the newest in force, by "
      "motion on\nthe setup of the machine that sent it.\n\nExample:\n  dnc import show O0200 4");
  run_at_server(show, context, show_options, show_import);

  auto accept = group.add_subcommand("accept", "Accept a revision, so that it can run");
  auto accept_options = std::make_shared<ImportChoice>();
  add_choice(accept, accept_options);
  accept.add_option("--as", accept_options->target,
                    "Make it a revision of this program instead, and hide it here");
  accept.add_option("--comment", accept_options->comment, "State why; kept with the decision");
  add_json_flag(accept, context);
  accept.footer(
      "Under a release policy it is a draft then. The decision is in the audit trail.\n\n"
      "Example:\n  dnc import accept O0200 4 --as O0201 --comment \"variant for lathe 2\"");
  run_at_server(accept, context, accept_options, accept_import);

  auto reject = group.add_subcommand("reject", "Reject a revision: it is hidden and never runs");
  auto reject_options = std::make_shared<ImportChoice>();
  add_choice(reject, reject_options);
  reject.add_option("--reason", reject_options->comment, "State why; kept with the decision")
      .required();
  add_json_flag(reject, context);
  reject.footer("Example:\n  dnc import reject O0200 4 --reason \"feed is too high\"");
  run_at_server(reject, context, reject_options, reject_import);
}

}  // namespace dripline::cli
