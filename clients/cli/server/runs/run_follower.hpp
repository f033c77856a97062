#pragma once

#include <chrono>
#include <optional>

#include "clients/cli/context.hpp"
#include "clients/lib/client.hpp"

namespace dripline::cli {

enum class WatchStyle {
  Live,    ///< a live line on a terminal, lines of changes in a pipe
  Silent,  ///< only the outcome
};

/// Follows a run to its end and prints the outcome. Returns the exit status: by the run's outcome,
/// kExitInterrupted on Ctrl-C, or kExitTimeout when it has not ended in time; both leave the run
/// alone.
int watch_run(Context& context, client::Client& client, client::Run run, WatchStyle style,
              std::optional<std::chrono::seconds> timeout = {});

}  // namespace dripline::cli
