#pragma once

#include <array>
#include <map>
#include <optional>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

/// The interface of a HEIDENHAIN TNC 151/155 by its machine parameters and MOD functions, and the
/// line that fits: MP 71 and 218 to 224, the baud rate (HEIDENHAIN, manual of the data interface).
namespace dripline::wire {

/// The rates of the MOD function BAUD RATE.
inline constexpr std::array kTncBaudRates{110u, 150u, 300u, 600u, 1200u, 2400u, 4800u, 9600u};
/// Errors: LimitExceeded, naming them all.
Result<void> check_tnc_baud(unsigned baud);

/// Machine parameters by their numbers; an absent one has its usual value.
using TncParameters = std::map<int, double>;

struct TncInterface {
  TncParameters parameters;
  unsigned baud = 2400;
  /// The letter in headings of the blockwise transfer where it is known from another source than
  /// MP 218: later versions have H in the parameter, this control may send %.
  std::optional<char> heading;
};

/// The line of such a control. Errors: LimitExceeded, Unsupported; naming the parameter, its value
/// and what is allowed.
Result<LineSettings> line_of_tnc(const TncInterface& interface);

/// MP 71 and 218 to 224 for a line. Errors: Unsupported, LimitExceeded, naming the setting that the
/// control has no value for, such as another protocol or 19200 baud.
Result<TncParameters> tnc_parameters_of_line(const LineSettings& line);

}  // namespace dripline::wire
