#include "gateway/interpreter/core/jog_move.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/operator_words.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter {

namespace {

constexpr std::string_view kHold = "hold=", kKeep = "keep=";

}  // namespace

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
  return fmt::format("{} {} {}{}{}", letter(move.axis), move.distance, unit,
                     move.feed ? fmt::format(" F{}", *move.feed) : "",
                     move.hold.empty() ? "" : " hold=" + move.hold);
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
  if (text.starts_with('F')) {
    double feed = 0;
    if (!read_number(take_word(text).substr(1), feed)) return refuse();
    if (!(std::isfinite(feed) && feed > 0)) return refuse();
    move.feed = feed;
  }
  if (text.empty()) return move;
  if (!text.starts_with(kHold) || !is_hold_word(text.substr(kHold.size()))) return refuse();
  move.hold = text.substr(kHold.size());
  return move;
}

bool is_hold_word(std::string_view word) {
  constexpr std::size_t kLongest = 64;
  return !word.empty() && word.size() <= kLongest && std::ranges::all_of(word, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
  });
}

std::string keep_text(std::string_view hold) {
  return fmt::format("{}{}", kKeep, hold);
}

std::optional<std::string> parse_jog_keep(std::string_view text) {
  if (!text.starts_with(kKeep) || !is_hold_word(text.substr(kKeep.size()))) return std::nullopt;
  return std::string(text.substr(kKeep.size()));
}

}  // namespace dripline::interpreter
