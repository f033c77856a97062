#include "clients/cli/setup/loaded_setup.hpp"

#include <fmt/format.h>
#include <memory>

#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/api_json.hpp"

namespace dripline::cli {
namespace {

struct LoadedCommand {
  std::string machine;
  std::optional<std::uint64_t> revision;
  bool is_unknown = false;
};

int say(Context& context, const client::LoadedSetup& loaded) {
  if (context.wants_json) {
    context.print(json_text(loaded));
  } else if (loaded.revision) {
    context.print(fmt::format("Setup {} is in the control of {}, says {}, {}\n", *loaded.revision,
                              loaded.machine, loaded.who, time_text(loaded.time)));
  } else {
    context.print(fmt::format("Which setup is in the control of {} is not known, says {}, {}\n",
                              loaded.machine, loaded.who, time_text(loaded.time)));
  }
  return kExitOk;
}

/// A run has the setup that was in the control when it was started.
void warn_of_runs(client::Client& client, const std::string& machine) {
  for (const char* state : {"ordered", "active"}) {
    const auto runs = client.runs({.machine = machine, .program = {}, .state = state, .page = {}});
    if (!runs) return;
    for (const client::Run& run : *runs) {
      print_error(
          "dnc: run {} of {} was started before and keeps {}: what it makes counts under "
          "that\n",
          run.id, run.program, run.setup ? fmt::format("setup {}", *run.setup) : "no known setup");
    }
  }
}

int loaded(Context& context, const LoadedCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  const bool is_said = command.revision || command.is_unknown;
  const auto known = is_said ? client->note_loaded_setup(command.machine, command.revision)
                             : client->loaded_setup(command.machine);
  if (!known) return complain(known.error());
  if (is_said) warn_of_runs(*client, command.machine);
  return say(context, *known);
}

}  // namespace

void add_loaded_setup(Command group, Context& context) {
  auto command = group.add_subcommand(
      "loaded", "State which setup is in a control at the end of a line, or show it");
  auto options = std::make_shared<LoadedCommand>();
  command.add_option("MACHINE", options->machine, "The machine").required();
  auto revision = command.add_option(
      "REVISION", options->revision,
      "Version that is in the control from now on; without it what was said last is shown");
  command.add_flag("--unknown", options->is_unknown, "Which one is in it is not known any more")
      .excludes(revision);
  add_json_flag(command, context);
  command.footer(
      "Such a control gets no setup with a start: someone loads it there (dnc setup export), and "
      "says so here.\nRuns that are started later have this setup; only then is it known under "
      "which offsets their parts\nwere cut. Say --unknown when values were changed at the "
      "control.\n\nExample:\n  dnc setup export mill-3 -r 7 -o tools.txt\n  dnc program push "
      "tools.txt --name TOOLS-7\n  dnc port send line-3 TOOLS-7\n  dnc setup loaded mill-3 7");
  command.callback([&context, options] { context.status = loaded(context, *options); });
}

}  // namespace dripline::cli
