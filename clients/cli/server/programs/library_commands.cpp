#include "clients/cli/server/programs/library_commands.hpp"

#include <memory>

#include "clients/cli/server/programs/release_commands.hpp"
#include "clients/cli/text/named_revision.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct SetCommand {
  std::string program;
  client::FieldChange fields;
};

int set_fields(Context& context, client::Client& client, const SetCommand& command) {
  const NamedRevision named = named_revision(command.program);
  const auto history = client.describe_program(named.program, named.revision, command.fields);
  if (!history) return complain(history.error());
  const client::Program& program = history->program;
  Details details;
  details.add("program", printable(program.name));
  details.add("part", printable(program.part));
  details.add("operation", printable(program.operation));
  details.add("material", printable(program.material));
  details.add("machine group", printable(program.machine_group));
  if (command.fields.cam_file) {
    const std::uint64_t shown = named.revision.value_or(program.revision);
    for (const auto& revision : history->revisions) {
      if (revision.revision == shown)
        details.add(fmt::format("CAM file of revision {}", shown), printable(revision.cam_file));
    }
  }
  context.print(details);
  return kExitOk;
}

struct SearchCommand {
  std::vector<std::string> words;
  client::SearchQuery query;
  std::uint64_t limit = 20;
};

/// Pages until there are `limit` hits.
client::Reply<client::SearchResult> search_all(client::Client& client,
                                               const SearchCommand& command) {
  constexpr std::uint64_t kPage = 100;
  client::SearchQuery query = command.query;
  for (const auto& word : command.words) query.words += (query.words.empty() ? "" : " ") + word;
  client::SearchResult all;
  while (all.hits.size() < command.limit) {
    query.limit = std::min(kPage, command.limit - all.hits.size());
    auto page = client.search(query);
    if (!page) return page;
    for (auto& hit : page->hits) all.hits.push_back(std::move(hit));
    all.next = page->next;
    all.to_be_indexed = page->to_be_indexed;
    if (!page->next) break;
    query.before = *page->next;
  }
  return all;
}

int search(Context& context, client::Client& client, const SearchCommand& command) {
  const auto found = search_all(client, command);
  if (!found) return complain(found.error());
  if (context.wants_json) {
    context.print(json_text(*found));
    return kExitOk;
  }
  Table table(
      {"PROGRAM", right("REV"), "STATE", "CONTROL", "PART", "AUTHOR", right("LINE"), "TEXT"});
  bool is_partly = false;
  for (const auto& hit : found->hits) {
    const client::Revision& revision = hit.revision;
    table.add({printable(revision.program), std::to_string(revision.revision),
               state_text(revision.state), printable(revision.control), printable(hit.part),
               printable(revision.author), hit.line ? std::to_string(*hit.line) : std::string(),
               printable(hit.line ? hit.text : revision.comment)});
    is_partly |= hit.partly_indexed;
  }
  if (table.empty()) context.print("Nothing was found.\n");
  if (!table.empty()) context.print(table);
  if (found->next) context.print("\nThere is more: --limit N shows it.\n");
  if (is_partly) context.print("\nOf texts over 256 KiB only the beginning is searched.\n");
  if (found->to_be_indexed > 0) {
    context.print(fmt::format("\n{} program{} still being indexed.\n", found->to_be_indexed,
                              found->to_be_indexed == 1 ? " is" : "s are"));
  }
  return kExitOk;
}

}  // namespace

void add_field_options(Command command, client::FieldChange& fields) {
  command.add_option("--part", fields.part, "The workpiece that the program makes");
  command.add_option("--operation", fields.operation, "Which of the part's operations it is");
  command.add_option("--material", fields.material, "Material of the workpiece");
  command.add_option("--machine-group", fields.machine_group,
                     "The group whose machines it is for (dnc group list)");
  command.add_option("--cam-file", fields.cam_file, "Where the revision's text comes from");
}

void add_choice_options(Command command, client::ProgramChoice& choice) {
  command.add_option("--part", choice.part, "Only programs of this part");
  command.add_option("--operation", choice.operation, "Only this operation");
  command.add_option("--material", choice.material, "Only this material");
  command.add_option("--machine-group", choice.machine_group, "Only programs for this group");
  command.add_option("--control", choice.control, "Only programs for this control");
  command.add_option("--author", choice.author, "Only revisions of this author");
  command.add_option("--state", choice.state, "Only revisions in this state")
      .check(one_of({"draft", "in_review", "approved", "released", "withdrawn"}));
}

void add_library_commands(Command group, Context& context) {
  auto set = group.add_subcommand("set", "Set what a program is for, or where its text comes from");
  auto options = std::make_shared<SetCommand>();
  set.add_option("PROGRAM", options->program, "NAME, or NAME@REVISION for --cam-file").required();
  add_field_options(set, options->fields);
  set.footer(
      "Part, operation, material and machine group belong to the program, whatever its revision; "
      "the "
      "CAM file\nbelongs to a revision. An empty text takes a value away. The change is in the "
      "audit "
      "trail.\n\nExample:\n  dnc program set O0200 --part 4711-12 --operation 20 --material "
      "1.4301");
  run_at_server(set, context, options, set_fields);

  auto find =
      group.add_subcommand("search", "Search names, fields, comments and texts of programs");
  auto search_options = std::make_shared<SearchCommand>();
  find.add_option("WORDS", search_options->words,
                  "Words that must all be there; rou* begins a word")
      .required();
  add_choice_options(find, search_options->query.choice);
  find.add_option("--machine", search_options->query.machine,
                  "Only programs for a group that this machine is in");
  find.add_flag("--replaced", search_options->query.with_replaced,
                "Also revisions that a newer one in force has replaced");
  find.add_option("--limit", search_options->limit, "Hits to show [20]")
      .check(in_range(1u, 10000u));
  add_json_flag(find, context);
  find.footer(
      "Capitals mean nothing, and g1, G01 and G1 are one word. Of a text the first 256 KiB are "
      "searched, without\ncoordinates (X10.5 ...) and N numbers. What changed last comes "
      "first.\n\nExample:\n  dnc program search T12 pocket --control fanuc --state released");
  run_at_server(find, context, search_options, search);
}

}  // namespace dripline::cli
