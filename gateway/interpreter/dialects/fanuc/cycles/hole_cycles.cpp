#include "gateway/interpreter/dialects/fanuc/execution/execution.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Of G51; 1 without it.
double scale_along(const ModalState& state, Axis axis) {
  return state.g[kScalingGroup] == 51 ? std::fabs(state.scaling.factor[place(axis)]) : 1;
}

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

const CycleRow& cycle_row(std::uint8_t code) {
  return *std::find_if(kCycles.begin(), kCycles.end(),
                       [code](const CycleRow& row) { return row.code == code; });
}

/// Of a thread that a rigid tap cuts, millimeters.
constexpr double kMaxPitch = 500;

/// Feeds of one block, so that a step never delivers without bound.
constexpr double kMaxPecks = 100'000;

bool is_tapping(std::uint8_t code) {
  return code == 74 || code == 84;
}

/// A rigid tap goes down in strokes of Q, unless there is none or it is 0.
bool pecks_in_tap(const Run& run) {
  const ModalState& state = run.state;
  return state.is_rigid_tapping && is_tapping(state.g[kCycleGroup]) && state.cycle.has_depth &&
         state.cycle.depth > 0;
}

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
        return run_.state.is_rigid_tapping ? tap_down() : feed(data().bottom);
      case PeckWithBreak:
        return peck(false);
      case PeckWithRetract:
        return peck(true);
      case FeedToRetract:
        return run_.state.is_rigid_tapping ? tap(data().retract) : feed(data().retract);
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

bool read_repeats(Run& run, double& repeats) {
  const Words& words = run.block.words;
  const RepeatAddress by = run.options.repeat_address;
  const bool by_k = by != RepeatAddress::L && words.has(K);
  const bool by_l = by != RepeatAddress::K && words.has(L);
  repeats = 1;
  if (!by_k && !by_l) return true;
  const Word& word = words[by_k ? K : L];
  run.ledger.take(set_of(by_k ? K : L));
  repeats = run.whole(word);
  if (repeats >= 0 && repeats <= 9999 && repeats == std::trunc(repeats)) return true;
  return run.fail(ErrorCode::TooManyDigits, word.column,
                  fmt::format("{} repeats are not 0 to 9999", repeats));
}

/// The word of the hole's own axis.
Address level_word(const Run& run) {
  constexpr std::array<Address, 3> kLevels{X, Y, Z};
  return kLevels[place(axes_of(run.state.plane()).normal)];
}

/// Z, R, Q and P of the block; R counts from the initial level in G91, Z from R.
bool keep_data(Run& run, double present) {
  ModalState& state = run.state;
  CycleData& data = state.cycle;
  const Words& words = run.block.words;
  const Address level = level_word(run);
  const bool is_incremental = state.is_incremental();
  if (words.has(R)) {
    const double value = run.length(words[R]);
    data.retract = is_incremental ? data.initial + value : value;
    data.has_retract = true;
  } else if (!data.has_retract) {
    data.retract = present;
  }
  if (words.has(level)) {
    const double value = run.length(words[level]);
    data.bottom = is_incremental ? data.retract + value : value;
    data.has_bottom = true;
  } else if (!data.has_bottom) {
    data.bottom = data.retract;
  }
  if (words.has(Q)) {
    data.depth = std::fabs(run.length(words[Q]));
    data.has_depth = true;
  }
  if (words.has(P) && !run.block.parts.p_is_work_system) data.dwell = run.whole(words[P]) / 1000;
  const std::uint8_t code = state.g[kCycleGroup];
  const bool pecks = code == 73 || code == 83;
  if (pecks && !(data.has_depth && data.depth > 0)) {
    return run.fail(ErrorCode::NoQ, run.block.parts.g_column);
  }
  const bool shifts = data.has_depth && data.depth > 0;
  if (code == 87 && !shifts) {
    return run.fail(ErrorCode::NoQ, run.block.parts.g_column,
                    "G87 would go down to R without its shift");
  }
  if (code == 76 && !shifts) run.warn(WarningCode::CycleWithoutShift, run.block.parts.g_column);
  if (!is_tapping(code)) return true;
  if (!state.is_rigid_tapping && state.spindle.revolutions == 0) {
    run.warn(WarningCode::TapWithoutSpeed, run.block.parts.g_column);
  }
  if (!state.is_rigid_tapping && words.has(Q) && data.depth > 0) {
    return run.fail(ErrorCode::ImproperCommand, words.column(Q),
                    "a tap pecks only in rigid tapping (M29)");
  }
  if (pecks_in_tap(run) && run.block.names(kCycleGroup) && !words.has(Q)) {
    run.warn(WarningCode::KeptPeck, run.block.parts.g_column);
  }
  return true;
}

/// Rapids end at R, and go on to the initial level: R lies between it and the bottom. What else is
/// written runs, as on the control, but not without a word.
void check_levels(Run& run) {
  const CycleData& data = run.state.cycle;
  const double down = data.bottom - data.retract;
  const double approach = data.retract - data.initial;
  if (!data.has_bottom || !data.has_retract) {
    run.warn(WarningCode::CycleLevels, run.block.parts.g_column,
             data.has_retract ? "no bottom is written, R is taken"
                              : "no R is written, the level reached is taken");
  } else if (run.state.g[kCycleGroup] != 87 && down * approach < 0) {
    run.warn(
        WarningCode::CycleLevels, run.block.parts.g_column,
        fmt::format("initial {:.6g}, R {:.6g}, bottom {:.6g}", run.in_units(Axis::Z, data.initial),
                    run.in_units(Axis::Z, data.retract), run.in_units(Axis::Z, data.bottom)));
  }
}

bool check_pecks(Run& run, double repeats) {
  const CycleData& data = run.state.cycle;
  const std::uint8_t code = run.state.g[kCycleGroup];
  if (code != 73 && code != 83 && !pecks_in_tap(run)) return true;
  const double scale = scale_along(run.state, axes_of(run.state.plane()).normal);
  const double pecks = std::fabs(data.bottom - data.retract) * scale / data.depth * repeats;
  if (pecks <= kMaxPecks) return true;
  return run.fail(ErrorCode::LoopLimit, run.block.words.column(Q),
                  fmt::format("{:.0f} pecks in one block", pecks));
}

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
  run.state.cycle = CycleData{};
  run.state.cycle.initial = program_position(run)[place(axes_of(run.state.plane()).normal)];
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
