#pragma once

#include "server/ports/port_line.hpp"

namespace dripline::ports {

/// Examines an idle line, for at most `wait` to open and `listen` more, and reports in words what
/// can be found without a program. Waits on the caller's thread.
struct ExamineTimes {
  std::chrono::milliseconds wait{3000};
  std::chrono::milliseconds listen{1500};
};
PortTest examine(PortLine& line, ExamineTimes times);

}  // namespace dripline::ports
