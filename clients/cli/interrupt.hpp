#pragma once

#include <chrono>

namespace dripline::cli {

/// From here on Ctrl-C (and SIGTERM) set a flag instead of ending the process at once; a second
/// Ctrl-C does end it.
void catch_interrupts();
bool is_interrupted();
/// False when interrupted before the time was over.
bool wait_unless_interrupted(std::chrono::milliseconds time);

}  // namespace dripline::cli
