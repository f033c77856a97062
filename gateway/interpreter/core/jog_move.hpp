#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter {

/// One step of one axis that an operator asks for without a program: a jog, or a click of a
/// handwheel.
struct JogMove {
  Axis axis = Axis::X;
  double distance = 0;              ///< with its sign; X of a lathe: of the diameter
  Units units = Units::Millimeter;  ///< of distance and feed, where the axis is linear
  std::optional<double> feed = {};  ///< per minute, of the axis itself; nothing: the gateway's
  /// The word with which it is kept moving, else it stops before its end: a held jog. Empty: a step
  /// that moves to its end by itself.
  std::string hold = {};

  /// In millimeters or degrees; X of a lathe as it is given.
  double canonical() const { return in_mm(distance); }
  std::optional<double> canonical_feed() const;
  friend bool operator==(const JogMove&, const JogMove&) = default;

 private:
  double in_mm(double value) const;
};

/// "X -1.5 mm", "C 0.1 deg F300", "X 50 mm F300 hold=3f2a"
std::string to_text(const JogMove& move);
/// Errors: Syntax (also a distance of 0, a feed that is not above 0, and what is not finite).
Result<JogMove> parse_jog_move(std::string_view text);

/// "keep=3f2a": lets the jog that is held by that word move on for a moment.
std::string keep_text(std::string_view hold);
/// Nothing: the text keeps no jog.
std::optional<std::string> parse_jog_keep(std::string_view text);
/// 1 to 64 letters, digits and `-`.
bool is_hold_word(std::string_view word);

}  // namespace dripline::interpreter
