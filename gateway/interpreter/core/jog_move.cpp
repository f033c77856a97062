#include "gateway/interpreter/core/jog_move.hpp"

#include <fmt/format.h>
#include <cmath>

#include "gateway/interpreter/core/operator_words.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter {

double JogMove::in_mm(double value) const {
  const bool is_inch = units == Units::Inch && !is_rotary(axis);
  return is_inch ? Length::inch(value).mm() : value;
}

std::optional<double> JogMove::canonical_feed() const {
  return feed ? std::optional(in_mm(*feed)) : std::nullopt;
}

std::string to_text(const JogMove& move) {
  const std::string_view unit = is_rotary(move.axis)        ? "deg"
                                : move.units == Units::Inch ? "in"
                                                            : "mm";
  return fmt::format("{} {} {}{}", letter(move.axis), move.distance, unit,
                     move.feed ? fmt::format(" F{}", *move.feed) : "");
}

Result<JogMove> parse_jog_move(std::string_view text) {
  const std::string whole(text);
  const auto refuse = [&] {
    return fail(Errc::Syntax, "'{}': expected an axis, a distance and a feed: 'X -1.5 mm F300'",
                whole);
  };
  JogMove move;
  const std::string_view axis = take_word(text);
  if (axis.size() != 1 || !axis_of(axis[0])) return refuse();
  move.axis = *axis_of(axis[0]);
  if (!read_number(take_word(text), move.distance)) return refuse();
  if (!std::isfinite(move.distance) || move.distance == 0) return refuse();
  const std::string_view unit = take_word(text);
  if (is_rotary(move.axis) ? unit != "deg" : unit != "mm" && unit != "in") return refuse();
  if (unit == "in") move.units = Units::Inch;
  if (text.empty()) return move;
  double feed = 0;
  if (!text.starts_with('F') || !read_number(text.substr(1), feed)) return refuse();
  if (!(std::isfinite(feed) && feed > 0)) return refuse();
  move.feed = feed;
  return move;
}

}  // namespace dripline::interpreter
