#pragma once

#include <string>
#include <vector>

namespace dripline::line {

class PortLine;

struct PortTest {
  bool is_passed = false;
  std::vector<std::string> findings;  ///< one a line, for people
};

/// Examines an idle line and reports in words what can be found without a program. Waits on the
/// caller's thread, some seconds.
PortTest examine(PortLine& line);

}  // namespace dripline::line
