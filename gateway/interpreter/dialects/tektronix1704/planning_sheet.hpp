#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::interpreter::tektronix1704 {

/// A tape's blocks in the columns of the control's planning sheet, N to M, as written but without
/// leading zeros; blocks that do not read follow an exclamation mark as they are (manual: planning
/// sheet).
Result<std::string> planning_sheet(std::string_view text);

}  // namespace dripline::interpreter::tektronix1704
