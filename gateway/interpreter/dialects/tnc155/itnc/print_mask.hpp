#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/local_time.hpp"
#include "protocol/base/result.hpp"

/// The mask of FN 16: F-PRINT, which says how texts and values are put out. Pure.
namespace dripline::interpreter::tnc155::itnc {

/// What a mask makes of the values now. Each line of it is quoted text, with a `%` for each value
/// that is listed after it: `"X = %9.3LF", Q31;`. Values are Q parameters as the program has them
/// and the parts of date and time (DAY, MONTH, YEAR2, YEAR4, HOUR, MIN, SEC). `*` at the beginning
/// of a line is a comment, M_CLOSE the end of the output. Source: iTNC 530, User's Manual, FN 16.
struct PrintedMask {
  std::vector<std::string> lines;
  bool needs_time = false;  ///< a part of the time was asked for, and `now` is absent
};

/// Errors: Syntax, Unsupported; naming the line of the mask and the word.
Result<PrintedMask> print_mask(std::string_view mask, std::span<const double> parameters,
                               const std::optional<LocalTime>& now);

}  // namespace dripline::interpreter::tnc155::itnc
