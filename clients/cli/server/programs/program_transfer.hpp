#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "clients/cli/context.hpp"

namespace dripline::cli {

struct PushCommand {
  std::string file, name, control, comment;  ///< empty: not given
  bool overrides_protection = false;
  client::FieldChange fields = {};
};
struct PullCommand {
  std::string name, output;  ///< output empty: `name` in this folder; "-": standard output
  std::optional<std::uint64_t> revision;
};

/// Both show a progress bar on a terminal and give the exit status.
int push(Context& context, const PushCommand& command);
int pull(Context& context, const PullCommand& command);

}  // namespace dripline::cli
