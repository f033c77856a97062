
#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {
namespace {

bool names_axis(const Run& run, Axis axis) {
  return (run.block.words.present() & set_of_axis(axis)) != 0;
}

bool check_reference(Run& run) {
  constexpr double kAtReference = 1e-6;
  Position to;
  if (!read_target(run, to) || !rapid_to(run, to)) return false;
  for (const Axis axis : kAllAxes) {
    if (!names_axis(run, axis)) continue;
    const double reference = run.options.reference[0][static_cast<std::size_t>(axis)];
    if (std::fabs(run.state.position.raw(axis) - reference) <= kAtReference) continue;
    return run.fail(ErrorCode::NotAtReference, run.block.words.first_column(set_of_axis(axis)),
                    fmt::format("{}", letter(axis)));
  }
  return true;
}

bool moves_in_plane(const Run& run, const Position& to) {
  const PlaneAxes axes = axes_of(run.state.plane());
  const Position& from = run.state.position;
  return to.raw(axes.first) != from.raw(axes.first) || to.raw(axes.second) != from.raw(axes.second);
}

/// The intermediate point is reached with the compensation's vector, the reference point without.
bool return_to(Run& run, std::size_t point) {
  ModalState& state = run.state;
  Position to;
  if (!read_target(run, to)) return false;
  interrupt_compensation(run, moves_in_plane(run, to));
  for (const Axis axis : kAllAxes) {
    if (!names_axis(run, axis)) continue;
    const auto i = static_cast<std::size_t>(axis);
    state.intermediate[i] = to.raw(axis);
    state.has_intermediate = static_cast<std::uint16_t>(state.has_intermediate | 1u << i);
  }
  if (!rapid_to(run, to)) return false;
  Position home = state.position;
  for (const Axis axis : kAllAxes) {
    if (!names_axis(run, axis)) continue;
    home.set_raw(axis, run.options.reference[point][static_cast<std::size_t>(axis)]);
  }
  return rapid_to(run, home);
}

/// Through the point remembered, which is also where increments count from.
bool come_back(Run& run) {
  ModalState& state = run.state;
  Position middle = state.position;
  bool is_known = true;
  for (const Axis axis : kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    if (!names_axis(run, axis)) continue;
    if ((state.has_intermediate >> i & 1u) == 0) {
      is_known = false;
      continue;
    }
    middle.set_raw(axis, state.intermediate[i]);
  }
  if (!is_known) run.warn(WarningCode::ReturnWithoutReference, run.block.parts.g_column);
  if (!rapid_to(run, middle)) return false;
  Position to;
  return read_target(run, to) && rapid_to(run, to);
}

}  // namespace

bool execute_reference(Run& run) {
  const ModalState& state = run.state;
  const Words& words = run.block.words;
  const std::uint32_t column = run.block.parts.g_column;
  if (state.is_cycle()) return run.fail(ErrorCode::HomeInCycle, column);
  if (state.is_transformed) return run.fail(ErrorCode::RotationHome, column);
  if (!words.has_any(kAxisWords)) return true;
  run.ledger.take(kAxisWords);
  switch (run.block.parts.one_shot) {
    case 27:
      interrupt_compensation(run);
      return check_reference(run);
    case 28:
      return return_to(run, 0);
    case 29:
      interrupt_compensation(run);
      return come_back(run);
    default:
      break;
  }
  const double point = words.has(P) ? run.whole(words[P]) : 2;
  if (!(point >= 2 && point <= 4)) {
    return run.fail(ErrorCode::IllegalReference, words.column(P), fmt::format("P{}", point));
  }
  return return_to(run, static_cast<std::size_t>(point) - 1);
}

}  // namespace dripline::interpreter::fanuc
