#pragma once

#include <string>

#include "clients/cli/context.hpp"

/// Shows the traffic of a line, now and lately. Each function returns the exit status.
namespace dripline::cli {

struct MonitorCommand {
  std::string name;
  bool is_hex = false;
};
/// Until Ctrl-C.
int monitor_port(Context& context, client::Client& client, const MonitorCommand& command);

struct RecordingCommand {
  std::string name;
  std::string output;  ///< empty: for people, on standard output
  bool is_hex = false;
};
int show_recording(Context& context, client::Client& client, const RecordingCommand& command);

}  // namespace dripline::cli
