#pragma once

#include "clients/cli/exit_status.hpp"
#include "clients/cli/offline/offline_program.hpp"

namespace dripline::cli {

/// FILE, --control and --setup, as both offline verbs take them.
inline void add_offline_options(Command command, OfflineCommand& options) {
  command.add_option("FILE", options.file, "The NC program").required();
  command.add_option(
      "--control", options.control,
      "Its control, e.g. centurion (default: detected from the text and the file name)");
  command.add_option("--setup", options.setup,
                     "TOML file: start, tools, offsets, variables, answers, probe surfaces, "
                     "options of the control, library of called programs");
}

/// The status for an interpretation that could not be carried through: a program that never ends is
/// the program's fault, anything else (setup, missing answers) the user's to correct.
inline int complain_offline(const Error& error) {
  complain(error);
  return error.code == Errc::LimitExceeded ? kExitNo : kExitUsage;
}

}  // namespace dripline::cli
