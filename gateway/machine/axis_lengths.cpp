#include "gateway/machine/axis_lengths.hpp"

#include <fmt/format.h>
#include <cmath>

namespace dripline::machine {

using interpreter::Axis;

namespace {

constexpr double kSameLength = 1e-6;  ///< mm
/// Less may be the steps of a device whose position a program began with, mm.
constexpr double kNoMove = 0.02;

}  // namespace

void AxisLengths::begin(const interpreter::Position& at, const ToolLengths& lengths) {
  last_ = at;
  wanted_ = taken_ = lengths;
  changed_in_ = 0;
}

void AxisLengths::note(const interpreter::ActiveModes& modes, std::uint64_t block) {
  const ToolLengths wanted = axis_lengths_of(modes);
  if (wanted == wanted_) return;
  wanted_ = wanted;
  changed_in_ = block;
}

std::optional<std::string> AxisLengths::take(const Move& move) {
  if (move.block < changed_in_) {
    return "make this move: the control gives it after the length of the tool has changed, as "
           "compensation or a corner waits for the next blocks";
  }
  ToolLengths next = taken_;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (shifts_ || std::fabs(wanted_[i] - taken_[i]) <= kSameLength) {
      next[i] = wanted_[i];
      continue;
    }
    const auto axis = static_cast<Axis>(i);
    const char name = interpreter::letter(axis);
    if (!(std::fabs(move.to.raw(axis) - last_.raw(axis)) > kNoMove)) {
      return fmt::format(
          "make this move: the length of the tool along {} is {:.3f} mm and was {:.3f} mm when {} "
          "moved last, and this move leaves {} where it is: whether the control moves it by the "
          "length is not certain. Move {} to another place first",
          name, wanted_[i], taken_[i], name, name, name);
    }
    if (move.is_arc)
      return fmt::format("take a length of the tool along {} into force on an arc", name);
    next[i] = wanted_[i];
  }
  taken_ = next;
  last_ = move.to;
  return std::nullopt;
}

}  // namespace dripline::machine
