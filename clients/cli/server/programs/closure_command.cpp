#include <memory>

#include "clients/cli/server/programs/release_commands.hpp"
#include "clients/cli/text/named_revision.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using Site = client::Closure::Site;

struct ClosureCommand {
  std::string program, machine;
  std::vector<std::string> with;
};

std::string site_text(const Site& site) {
  return fmt::format("{}@{} line {}", printable(site.program), site.revision, site.line);
}

/// 1: something is missing, so that it cannot be released.
int print_missing(const Context& context, const client::Closure& closure) {
  for (const auto& missing : closure.missing) {
    context.print(fmt::format("missing: {} is not in the library for this control; called in {}\n",
                              printable(missing.name), site_text(missing.site)));
  }
  for (const Site& site : closure.computed) {
    context.print(
        fmt::format("computed: {} calls a program that a run computes; name it: --with NAME\n",
                    site_text(site)));
  }
  return closure.missing.empty() ? kExitOk : kExitNo;
}

int show_closure(Context& context, client::Client& client, const ClosureCommand& command) {
  const NamedRevision main = named_revision(command.program);
  const auto closure = client.closure({main.program, main.revision, command.machine, command.with});
  if (!closure) return complain(closure.error());
  if (context.wants_json) {
    context.print(json_text(*closure));
    return closure->missing.empty() ? kExitOk : kExitNo;
  }
  context.print(fmt::format("{} revision {} calls {} program{}\n", printable(closure->program),
                            closure->revision, closure->calls.size(),
                            closure->calls.size() == 1 ? "" : "s"));
  Table table({"CALLED AS", "PROGRAM", right("REV"), "STATE", "SHA-256", "IN"});
  for (const auto& call : closure->calls) {
    table.add({printable(call.name), printable(call.program), std::to_string(call.revision),
               state_text(call.state), short_id(call.sha256),
               call.site ? site_text(*call.site) : "named with --with"});
  }
  if (!table.empty()) context.print("\n");
  if (!table.empty()) context.print(table);
  return print_missing(context, *closure);
}

}  // namespace

void add_closure_command(Command group, Context& context) {
  auto command = group.add_subcommand("closure", "List what a program calls, and what that calls");
  auto options = std::make_shared<ClosureCommand>();
  command.add_option("PROGRAM", options->program, "NAME or NAME@REVISION").required();
  command.add_option("--machine", options->machine,
                     "Machine whose newest setup binds G, M and T codes to programs");
  command
      .add_option("--with", options->with,
                  "A program that is called too, or another revision: NAME or NAME@REVISION")
      .allow_extra_args(false);
  add_json_flag(command, context);
  command.footer(
      "The texts are read as the interpreter of the control reads calls: M98, G65, G66, O-words, "
      "CALL PGM, CALL ...,\nalso in branches that a run may not take. The revisions are those that "
      "a run started now would get.\n`dnc program release --closure` pins them.\n\nExit status: 0 "
      "all are there, 1 one is missing.\n\nExample:\n  dnc program closure O0200@3");
  run_at_server(command, context, options, show_closure);
}

}  // namespace dripline::cli
