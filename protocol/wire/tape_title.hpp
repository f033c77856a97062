#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::wire {

/// Appends a title that people read on the tape itself: each character is five rows of hole
/// patterns in tracks 1-7 and one blank row. None of these rows is an end of block of any code, so
/// a control skips the title. Errors: Syntax (not A-Z, 0-9, blank, '-', '.' or '/').
Result<void> punch_title(std::string_view title, std::vector<std::byte>& rows);

}  // namespace dripline::wire
