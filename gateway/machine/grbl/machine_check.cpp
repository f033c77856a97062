#include "gateway/machine/grbl/machine_check.hpp"

#include <cmath>

namespace dripline::machine::grbl {
namespace {

using AxisData = interpreter::MachineData::AxisData;

bool is_same(double stated, double on_board) {
  constexpr double kRounding = 0.002;  // settings have three decimals
  return std::fabs(stated - on_board) <= kRounding + 1e-4 * std::fabs(stated);
}

Result<void> check_axis(const AxisData& stated, std::size_t axis, const BoardInfo& board) {
  const char name = letter_of(axis);
  if (axis >= board.axes())
    return fail(Errc::Conflict, "the setup has an axis {}, the board has not", name);
  if (stated.max_rate && !is_same(*stated.max_rate, board.max_rate(axis)))
    return fail(Errc::Conflict,
                "the rate of {} is {:.6g} in the setup and {:.6g} on the board (${})", name,
                *stated.max_rate, board.max_rate(axis), 110 + axis);
  if (!stated.min) return {};
  const auto travel = board.travel(axis);
  if (!travel)
    return fail(Errc::Conflict,
                "the setup has a travel of {}, the board's soft limits are off ($20, ${})", name,
                130 + axis);
  if (is_same(*stated.min, travel->low) && is_same(*stated.max, travel->high)) return {};
  return fail(Errc::Conflict,
              "the travel of {} is {:.6g} to {:.6g} in the setup and {:.6g} to {:.6g} on the board "
              "(${}, $23)",
              name, *stated.min, *stated.max, travel->low, travel->high, 130 + axis);
}

}  // namespace

Result<void> check_machine(const interpreter::MachineData& stated, const BoardInfo& board) {
  for (std::size_t i = 0; i < stated.axes.size(); ++i) {
    if (!stated.axes[i]) continue;
    if (auto same = check_axis(*stated.axes[i], i, board); !same) return same;
  }
  if (stated.max_rpm && !is_same(*stated.max_rpm, board.max_rpm()))
    return fail(Errc::Conflict, "max_rpm is {:.6g} in the setup and {:.6g} on the board ($30)",
                *stated.max_rpm, board.max_rpm());
  if (stated.homing && *stated.homing != board.homes())
    return fail(Errc::Conflict, "homing is {} in the setup and {} on the board ($22)",
                *stated.homing ? "on" : "off", board.homes() ? "on" : "off");
  return {};
}

}  // namespace dripline::machine::grbl
