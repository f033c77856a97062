#include "gateway/interpreter/dialects/fanuc/execution/execution.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/cycles/cycle_data.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// One thing a cycle does at its hole.
enum class Step : std::uint8_t {
  None,
  RapidToRetract,
  FeedToBottom,
  PeckWithBreak,    ///< feeds by Q, d back between
  PeckWithRetract,  ///< feeds by Q, out to R between
  FeedToRetract,
  RapidToReturn,  ///< the initial level with G98, R with G99
  RapidToInitial,
  Dwell,
  Clockwise,
  Counterclockwise,
  SpindleOff,
  Orient,
  FormerDirection,  ///< the spindle as before the cycle, clockwise when it did not turn
  ShiftAway,
  ShiftBack,
  ByHand,  ///< the operator retracts to R; what is left of that path is made after it
};

using enum Step;
struct CycleRow {
  std::uint8_t code;
  std::array<Step, 12> steps;
};
constexpr std::array kCycles{
    CycleRow{73, {RapidToRetract, PeckWithBreak, RapidToReturn}},
    CycleRow{74,
             {RapidToRetract, Counterclockwise, FeedToBottom, SpindleOff, Dwell, Clockwise,
              FeedToRetract, Dwell, Counterclockwise, RapidToReturn}},
    CycleRow{76,
             {RapidToRetract, FeedToBottom, Dwell, Orient, ShiftAway, RapidToReturn, ShiftBack,
              FormerDirection}},
    CycleRow{81, {RapidToRetract, FeedToBottom, RapidToReturn}},
    CycleRow{82, {RapidToRetract, FeedToBottom, Dwell, RapidToReturn}},
    CycleRow{83, {RapidToRetract, PeckWithRetract, RapidToReturn}},
    CycleRow{84,
             {RapidToRetract, Clockwise, FeedToBottom, SpindleOff, Dwell, Counterclockwise,
              FeedToRetract, Dwell, Clockwise, RapidToReturn}},
    CycleRow{85, {RapidToRetract, FeedToBottom, FeedToRetract, RapidToReturn}},
    CycleRow{86, {RapidToRetract, FeedToBottom, SpindleOff, RapidToReturn, FormerDirection}},
    CycleRow{87,
             {Orient, ShiftAway, RapidToRetract, ShiftBack, FormerDirection, FeedToBottom, Dwell,
              Orient, ShiftAway, RapidToInitial, ShiftBack, FormerDirection}},
    CycleRow{88,
             {RapidToRetract, FeedToBottom, Dwell, SpindleOff, ByHand, RapidToRetract,
              FormerDirection, RapidToReturn}},
    CycleRow{89, {RapidToRetract, FeedToBottom, Dwell, FeedToRetract, RapidToReturn}}};

/// G84.2 and G84.3 are G84 and G74 with the spindle led (Series 11 operator's manual, canned
/// cycles, rigid tapping; Series 30i user's manual for machining centers, Series 15 program
/// format).
const CycleRow& cycle_row(std::uint8_t code) {
  const std::uint8_t steps = code == kRigidTap ? 84 : code == kRigidTapLeft ? 74 : code;
  return *std::find_if(kCycles.begin(), kCycles.end(),
                       [steps](const CycleRow& row) { return row.code == steps; });
}

/// Of a thread that a rigid tap cuts, millimeters.
constexpr double kMaxPitch = 500;

/// One hole while it is made. Levels and places are program coordinates.
class Hole {
 public:
  Hole(Run& run, Point3 at) : run_(run), axes_(axes_of(run.state.plane())), at_(at) {
    const SpindleState now = run.state.spindle.state;
    former_ = now == SpindleState::Counterclockwise ? now : SpindleState::Clockwise;
  }

  bool make() {
    const std::uint8_t code = run_.state.g[kCycleGroup];
    const bool is_tap = is_tapping(code);
    for (const Step step : cycle_row(code).steps) {
      if (is_tap && step == RapidToReturn) lock(lock_after_tap(override_inhibit(run_)));
      if (!perform(step)) return false;
      if (is_tap && step == RapidToRetract) lock(tapping_lock(run_.origin));
    }
    if (is_tap) lock(override_inhibit(run_));
    return true;
  }

 private:
  const CycleData& data() const { return run_.state.cycle; }
  double return_level() const {
    return run_.state.g[kReturnGroup] == 98 ? data().initial : data().retract;
  }

  bool rapid(double level) {
    at_[place(axes_.normal)] = level;
    return rapid_to(run_, machine_point(run_, at_));
  }
  bool feed(double level) {
    at_[place(axes_.normal)] = level;
    return line_to(run_, machine_point(run_, at_), run_.active_feed());
  }
  /// Q and the retractions of a peck are as long as they are written under G51, too.
  double unscaled(double length) const { return length / scale_along(run_.state, axes_.normal); }
  /// With rigid tapping the spindle leads: G94 gives the pitch as feed over speed.
  bool tap(double level) {
    if (!is_tapping(run_.state.g[kCycleGroup])) return feed(level);
    const ModalState& state = run_.state;
    const double pitch =
        state.is_per_revolution() ? state.feed[1] : state.feed[0] / state.spindle.revolutions;
    if (!(pitch > 0 && pitch <= kMaxPitch)) return run_.fail(ErrorCode::NoSpeed, 0);
    at_[place(axes_.normal)] = level;
    return thread_to(run_, machine_point(run_, at_), Length::mm(pitch), {});
  }
  /// By Q at a time when there is one: between the strokes the tap retracts by d, or to R.
  bool tap_down() {
    if (!pecks_in_tap(run_)) return tap(data().bottom);
    const SpindleState in = run_.state.spindle.state;
    const SpindleState out =
        in == SpindleState::Clockwise ? SpindleState::Counterclockwise : SpindleState::Clockwise;
    const double travel = data().bottom - data().retract;
    const double sign = travel < 0 ? -1 : 1;
    const double stroke = unscaled(data().depth);
    const double count = std::ceil(std::fabs(travel) / stroke - 1e-9);
    for (double n = 1; n < count; ++n) {
      const double depth = n * stroke;
      const double back = run_.options.peck_tap_leaves
                              ? depth
                              : std::fmin(unscaled(run_.options.peck_tap_return), depth);
      if (!tap(data().retract + sign * depth)) return false;
      spindle(SpindleState::Off);
      spindle(out);
      if (!tap(data().retract + sign * (depth - back))) return false;
      spindle(SpindleState::Off);
      spindle(in);
    }
    return tap(data().bottom);
  }
  bool shift(double sign) {
    const double by = sign * data().depth;
    Position to = run_.state.position;
    to.set_raw(axes_.first, to.raw(axes_.first) + by * run_.options.shift_first);
    to.set_raw(axes_.second, to.raw(axes_.second) + by * run_.options.shift_second);
    if (sign < 0) to = machine_point(run_, at_);
    return rapid_to(run_, to);
  }
  void lock(const OverrideInhibit& lock) { run_.events().on_override_inhibit(lock); }
  bool spindle(SpindleState state) {
    turn_spindle(run_, state);
    return true;
  }

  bool perform(Step step) {
    switch (step) {
      case None:
        return true;
      case RapidToRetract:  // for G87 the tool stays shifted on its path down
        return run_.state.g[kCycleGroup] != 87 ? rapid(data().retract) : out(data().retract);
      case FeedToBottom:
        return run_.state.taps_rigidly() ? tap_down() : feed(data().bottom);
      case PeckWithBreak:
        return peck(false);
      case PeckWithRetract:
        return peck(true);
      case FeedToRetract:
        return run_.state.taps_rigidly() ? tap(data().retract) : feed(data().retract);
      case RapidToReturn:
        return out(return_level());
      case RapidToInitial:
        return out(data().initial);
      case Dwell:
        if (data().dwell > 0) run_.events().on_dwell({run_.origin, data().dwell, {}});
        return true;
      case Clockwise:
        return spindle(SpindleState::Clockwise);
      case Counterclockwise:
        return spindle(SpindleState::Counterclockwise);
      case SpindleOff:
        return spindle(SpindleState::Off);
      case Orient:
        return spindle(SpindleState::Oriented);
      case FormerDirection:
        return spindle(former_);
      case ShiftAway:
        return shift(1);
      case ShiftBack:
        return shift(-1);
      case ByHand:
        run_.events().on_stop({run_.origin, StopKind::Operator});
        return true;
    }
    return true;
  }

  /// Along the hole's axis only: a shifted tool stays shifted.
  bool out(double level) {
    at_[place(axes_.normal)] = level;
    Position to = run_.state.position;
    to.set_raw(axes_.normal, machine_point(run_, at_).raw(axes_.normal));
    return rapid_to(run_, to);
  }

  bool peck(bool to_retract) {
    const double travel = data().bottom - data().retract;
    const double sign = travel < 0 ? -1 : 1;
    const double back = unscaled(to_retract ? run_.state.parameters.peck_clearance
                                            : run_.state.parameters.peck_return);
    const double peck = unscaled(data().depth);
    const double count = std::ceil(std::fabs(travel) / peck - 1e-9);
    for (double n = 1; n < count; ++n) {
      const double depth = data().retract + sign * n * peck;
      if (!feed(depth)) return false;
      if (to_retract && !rapid(data().retract)) return false;
      // Never above R: a clearance can be longer than the first peck.
      const double above = std::fmin(back, n * peck);
      if (!rapid(depth - sign * above)) return false;
    }
    return feed(data().bottom);
  }

  Run& run_;
  PlaneAxes axes_;
  Point3 at_;
  SpindleState former_;
};

/// Where the next hole is; the hole's own axis stays at the level reached.
bool position_hole(Run& run, Point3& at) {
  const PlaneAxes axes = axes_of(run.state.plane());
  Position to;
  if (!read_target(run, to)) return false;
  Point3 point = program_point(run.state, to);
  point[place(axes.normal)] = program_position(run)[place(axes.normal)];
  Position over = machine_point(run, point);
  for (const Axis axis : {Axis::A, Axis::B, Axis::C, Axis::U, Axis::V, Axis::W}) {
    if (to.raw(axis) != over.raw(axis)) over.set_raw(axis, to.raw(axis));
  }
  at = point;
  return position_to(run, over);
}

}  // namespace

void begin_cycle_mode(Run& run) {
  const Axis axis = axes_of(run.state.plane()).normal;
  run.state.cycle = CycleData{};
  run.state.cycle.initial = program_position(run)[place(axis)];
  run.state.cycle.initial_raw = run.state.position.raw(axis);
}

bool execute_cycle(Run& run) {
  const Words& words = run.block.words;
  ModalState& state = run.state;
  if (!words.has_any(kAxisWords | set_of(R))) return true;
  if (state.is_inverse_time()) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column, "a hole cycle in G93");
  }
  run.ledger.take(kAxisWords | set_of(R, Q));  // Q stays, for a cycle that has a use for it
  const double present = program_position(run)[place(axes_of(state.plane()).normal)];
  double repeats = 1;
  if (!check_initial_level(run)) return false;
  const bool is_new = words.has_any(set_of(R, level_word(run))) || run.block.parts.begins_cycle;
  if (!keep_data(run, present) || !read_repeats(run, repeats)) return false;
  if (!check_pecks(run, repeats)) return false;
  if (repeats > 0 && !check_feed(run)) return false;
  if (repeats > 0 && is_new) check_levels(run);
  if (state.is_compensating()) {
    run.warn(WarningCode::CycleInCompensation, run.block.parts.g_column);
    interrupt_compensation(run);  // holes are where they are programmed
  }
  if (state.g[kCycleGroup] == 87 && state.g[kReturnGroup] == 99) {
    run.warn(WarningCode::BackBoringLevel, run.block.parts.g_column);
  }
  for (double n = 0; n < repeats; ++n) {
    Point3 at{};
    if (!position_hole(run, at) || !Hole(run, at).make()) return false;
  }
  resume_compensation(run);
  return true;
}

}  // namespace dripline::interpreter::fanuc
