#include <csignal>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "clients/tools/offline/trace_writer.hpp"

namespace dripline::cli {
namespace {

int trace(const OfflineCommand& command) {
  auto program = OfflineProgram::open(command);
  if (!program) return complain(program.error());
  std::signal(SIGPIPE, SIG_DFL);  // `dnc trace FILE | head` ends with head
  StandardOutput output;
  interpreter::TraceWriter writer(
      [&output](std::string_view text) { (void)output.write(text).has_value(); },
      program->setup().start);
  auto source = program->source();
  const auto outcome =
      interpreter::run_offline(program->dialect(), program->setup(), source, writer);
  writer.flush();
  if (output.error()) return output.complain();
  if (!outcome) return complain_offline(outcome.error());
  return outcome->ended ? kExitOk : kExitNo;
}

/// The program in the form the control knows it in, where that is not its text.
int print_listing(const OfflineCommand& command) {
  auto program = OfflineProgram::open(command);
  if (!program) return complain(program.error());
  const interpreter::Dialect& dialect = program->dialect();
  if (dialect.list == nullptr) {
    return complain(Error{Errc::Unsupported, std::string(dialect.name) +
                                                 " keeps programs as their text; "
                                                 "it has no listing of its own"});
  }
  const auto list = dialect.list(program->text());
  if (!list) {
    complain(list.error());
    return kExitNo;
  }
  return write_to("-", *list);
}

}  // namespace

void add_trace_command(Command app, Context& context) {
  auto command = app.add_subcommand("trace", "Print what a program does, one JSON object per line");
  auto options = std::make_shared<OfflineCommand>();
  add_offline_options(command, *options);
  auto events = std::make_shared<bool>(false);
  command.add_flag("--events,--listing", *events,
                   "Print the program in the control's own form: the events that a "
                   "prototrak-plus stores, the planning sheet of a tektronix-1704");
  command.footer(
      "No server is needed. Positions are in the program's units. Called programs come from the "
      "setup's\nlibrary, or from FILE's folder.\n\nExit status: 0 the end was reached, 1 an alarm "
      "(the last object), 2 usage, unreadable file, unknown control.\n\nExample:\n  dnc trace "
      "--control centurion --setup lathe.toml shaft.nc");
  command.callback([&context, options, events] {
    context.status = *events ? print_listing(*options) : trace(*options);
  });
}

}  // namespace dripline::cli
