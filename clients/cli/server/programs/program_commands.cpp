#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/server/programs/library_commands.hpp"
#include "clients/cli/server/programs/program_check.hpp"
#include "clients/cli/server/programs/program_diff.hpp"
#include "clients/cli/server/programs/program_transfer.hpp"
#include "clients/cli/server/programs/release_commands.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct RevisionCommand {
  std::string program;
  std::uint64_t revision = 0;
};

struct MoveCommand {
  std::string from, to;
  std::optional<std::uint64_t> revision;
};

Cell held_cell(std::uint64_t held) {
  return held == 0 ? Cell("") : Cell(std::to_string(held), Style::Busy);
}

/// The decision about a revision: only one that is not held can be run.
Cell standing_cell(const client::Program& program, const client::Revision& revision) {
  if (revision.held) return {"held", Style::Busy};
  if (revision.state == "released") return {"released", Style::Good};
  if (!revision.state.empty() && revision.state != "draft")
    return {state_text(revision.state), Style::Busy};
  if (revision.revision == program.revision) return {"latest", Style::Good};
  return "";
}

client::Reply<std::vector<client::Program>> chosen_programs(client::Client& client,
                                                            const client::ProgramChoice& choice) {
  constexpr std::uint64_t kPage = 200;
  std::vector<client::Program> all;
  for (;;) {
    auto page = client.programs(choice, kPage, all.empty() ? "" : all.back().name);
    if (!page) return page;
    const bool is_last = page->size() < kPage;
    for (auto& program : *page) all.push_back(std::move(program));
    if (is_last) return all;
  }
}

int list_programs(Context& context, client::Client& client, const client::ProgramChoice& choice) {
  auto programs = chosen_programs(client, choice);
  if (const auto status = finished(context, programs, "programs")) return *status;
  const bool has_fields = std::ranges::any_of(*programs, [](const client::Program& program) {
    return !program.part.empty() || !program.operation.empty();
  });
  std::vector<Column> columns{"NAME",    right("REV"), right("HELD"), right("SIZE"), "TITLE",
                              "CONTROL", "CREATED",    "AUTHOR",      "COMMENT"};
  if (has_fields) columns.insert(columns.begin() + 5, {"PART", "OP"});
  Table table(columns);
  std::uint64_t held = 0;
  for (const auto& program : *programs) {
    std::vector<Cell> cells{program.name,
                            program.held ? Cell("-") : Cell(std::to_string(program.revision)),
                            held_cell(program.held_revisions),
                            bytes_text(program.size),
                            program.title,
                            program.control,
                            time_text(program.created),
                            program.author,
                            program.comment};
    if (has_fields) cells.insert(cells.begin() + 5, {program.part, program.operation});
    table.add(std::move(cells));
    held += program.held_revisions;
  }
  if (table.empty()) {
    context.print(choice.is_empty() ? "The library is empty; dnc program push FILE fills it.\n"
                                    : "No program is like that.\n");
  }
  if (!table.empty()) context.print(table);
  if (held > 0) {
    context.print(fmt::format(
        "\n{} for acceptance: dnc program show NAME lists, dnc program accept NAME REV decides.\n",
        held == 1 ? "1 revision from a machine waits"
                  : fmt::format("{} revisions from machines wait", held)));
  }
  return kExitOk;
}

int show_program(Context& context, client::Client& client, const std::string& name) {
  auto history = client.program(name);
  if (const auto status = finished(context, history)) return *status;
  const auto& program = history->program;
  Details details;
  details.add("program", program.name);
  details.add("title", program.title);
  details.add("control", program.control);
  details.add("latest", program.held ? Cell("none: what is here waits for acceptance", Style::Busy)
                                     : Cell(fmt::format("revision {}, {}", program.revision,
                                                        bytes_text(program.size))));
  details.add("sha256", program.sha256);
  if (!program.part.empty()) details.add("part", program.part);
  if (!program.operation.empty()) details.add("operation", program.operation);
  if (!program.material.empty()) details.add("material", program.material);
  if (!program.machine_group.empty()) details.add("machine group", program.machine_group);
  if (!program.cam_file.empty()) details.add("CAM file", program.cam_file);
  context.print(details);
  Table table(
      {right("REV"), "STATE", right("SIZE"), "SHA-256", "CONTROL", "CREATED", "AUTHOR", "COMMENT"});
  for (const auto& revision : history->revisions) {
    table.add({std::to_string(revision.revision), standing_cell(program, revision),
               bytes_text(revision.size), short_id(revision.sha256), revision.control,
               time_text(revision.created), revision.author, revision.comment});
  }
  context.print("\n");
  context.print(table);
  return kExitOk;
}

struct RemoveCommand {
  std::string name;
  bool overrides_protection = false;
};

int remove_program(Context& context, client::Client& client, const RemoveCommand& command) {
  auto removed = client.remove_program(command.name, command.overrides_protection);
  if (!removed) return complain(removed.error());
  context.print(
      fmt::format("Removed {} from the library; its runs and reports stay.\n", command.name));
  return kExitOk;
}

int copy_program(Context& context, client::Client& client, const MoveCommand& command) {
  auto copy = client.copy_program(command.from, command.to, command.revision);
  if (!copy) return complain(copy.error());
  context.print(fmt::format("{} revision {}: {}, {}\n", copy->program, copy->revision,
                            copy->comment, bytes_text(copy->size)));
  return kExitOk;
}

int rename_program(Context& context, client::Client& client, const MoveCommand& command) {
  auto renamed = client.rename_program(command.from, command.to);
  if (!renamed) return complain(renamed.error());
  const auto count = renamed->revisions.size();
  context.print(fmt::format("{} is now {}, with {} revision{}; its runs and reports go with it.\n",
                            command.from, renamed->program.name, count, count == 1 ? "" : "s"));
  return kExitOk;
}

int accept_revision(Context& context, client::Client& client, const RevisionCommand& command) {
  auto accepted = client.accept_revision(command.program, command.revision);
  if (!accepted) return complain(accepted.error());
  context.print(fmt::format("Accepted {} revision {}: {}, sha256 {}\n", accepted->program,
                            accepted->revision, bytes_text(accepted->size),
                            short_id(accepted->sha256)));
  return kExitOk;
}

void add_accept(Command group, Context& context) {
  auto command = group.add_subcommand("accept", "Approve a pending revision, so that it can run");
  auto options = std::make_shared<RevisionCommand>();
  command.add_option("NAME", options->program, "The program").required();
  command.add_option("REV", options->revision, "Its revision").required();
  command.footer(
      "A program that an operator sent from a control is stored as a revision pending approval: it "
      "is listed\nand can be pulled, but no run takes it before it is accepted. The decision is in "
      "the audit trail.\n\nExample:\n  dnc program pull O0200 --revision 3 -o received.nc\n  dnc "
      "program accept O0200 3");
  run_at_server(command, context, options, accept_revision);
}

void add_push(Command group, Context& context) {
  auto command = group.add_subcommand("push", "Store FILE as a program, or as its next revision");
  auto options = std::make_shared<PushCommand>();
  command.add_option("FILE", options->file, "The NC program").required();
  command.add_option("--name", options->name, "Name in the library (default: FILE's name)");
  command.add_option(
      "--control", options->control,
      "The control it is written for, e.g. centurion (default: detected by the server)");
  command.add_option("--comment", options->comment, "State what changed; kept with the revision");
  command.add_flag("--force", options->overrides_protection,
                   "Replace the program even if it is protected against editing (tnc155: P, G50)");
  add_field_options(command, options->fields);
  add_json_flag(command, context);
  command.footer(
      "The content is sent in pieces with a SHA-256 that the server checks. When the connection "
      "breaks,\nit continues where the server stopped receiving. The same content again makes no "
      "new "
      "revision.\n\nExample:\n  dnc program push shaft.nc --name O0200 --control centurion "
      "--comment \"deeper groove\"");
  command.callback([&context, options] { context.status = push(context, *options); });
}

void add_pull(Command group, Context& context) {
  auto command = group.add_subcommand("pull", "Fetch a program's content");
  auto options = std::make_shared<PullCommand>();
  command.add_option("NAME", options->name, "The program").required();
  command.add_option("-o,--output", options->output,
                     "File to write, - for standard output (default: NAME here)");
  command.add_option("--revision", options->revision, "Revision to fetch (default: the latest)");
  command.footer(
      "The output file is written only when it is complete and its SHA-256 matches. On standard "
      "output the\nbytes come before the check: test the exit status.\n\nExample:\n  dnc program "
      "pull O0200 --revision 3 -o shaft.nc");
  command.callback([&context, options] { context.status = pull(context, *options); });
}

void add_show(Command group, Context& context) {
  auto command = group.add_subcommand("show", "Show a program and all its revisions");
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The program").required();
  add_json_flag(command, context);
  run_at_server(command, context, name, show_program);
}

void add_remove(Command group, Context& context) {
  auto command = group.add_subcommand(
      "remove", "Remove a program from the library; its runs and reports stay");
  auto options = std::make_shared<RemoveCommand>();
  command.add_option("NAME", options->name, "The program").required();
  command.add_flag("--force", options->overrides_protection,
                   "Remove even a protected program (tnc155: P, G50)");
  run_at_server(command, context, options, remove_program);
}

void add_copy(Command group, Context& context) {
  auto command = group.add_subcommand("copy", "Copy a program's revision to a new program");
  auto options = std::make_shared<MoveCommand>();
  command.add_option("NAME", options->from, "The program").required();
  command.add_option("NEW", options->to, "Name of the copy; no program may have it").required();
  command.add_option("--revision", options->revision, "Revision to copy (default: the latest)");
  command.footer(
      "The copy begins with that revision as its first; its source is in its comment "
      "and\nin the audit trail.\n\nExample:\n  dnc program copy O0200 O0201");
  run_at_server(command, context, options, copy_program);
}

void add_rename(Command group, Context& context) {
  auto command = group.add_subcommand("rename", "Give a program another name");
  auto options = std::make_shared<MoveCommand>();
  command.add_option("NAME", options->from, "The program").required();
  command.add_option("NEW", options->to, "Its new name; no program may have it").required();
  command.footer(
      "All its revisions, runs and reports go with it. It is refused while a run uses the program "
      "or a\nrevision of it is pending approval. The text stays as it is: an O number in it "
      "too.\n\nExample:\n  dnc program rename O0200 O0210");
  run_at_server(command, context, options, rename_program);
}

}  // namespace

void add_program_commands(Command app, Context& context) {
  auto group = app.add_subcommand("program", "Programs in the server's library");
  group.require_subcommand(1);
  add_push(group, context);
  add_pull(group, context);
  auto list = group.add_subcommand("list", "List programs with their latest revision");
  auto choice = std::make_shared<client::ProgramChoice>();
  add_choice_options(list, *choice);
  add_json_flag(list, context);
  run_at_server(list, context, choice, list_programs);
  add_show(group, context);
  add_accept(group, context);
  add_library_commands(group, context);
  add_attachment_commands(group, context);
  add_release_commands(group, context);
  add_program_check(group, context);
  add_program_diff(group, context);
  add_remove(group, context);
  add_copy(group, context);
  add_rename(group, context);
}

}  // namespace dripline::cli
