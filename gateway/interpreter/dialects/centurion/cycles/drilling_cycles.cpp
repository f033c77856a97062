#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/cycle_moves.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/cycle_words.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {

namespace {

constexpr int kCutLength = 121;
constexpr int kCutDepth = 122;
constexpr int kTurningTaper = 125;
constexpr int kFacingTaper = 126;

struct Box {
  Point start;
  Point cut_from;
  Point cut_to;
  Point out;
};

bool cut(Run& run, const Box& box) {
  if (!check_feed(run) || !check_target(run, box.cut_from)) return false;
  const Feed feed = run.active_feed();
  rapid_to(run, box.cut_from, kBothAxes);
  feed_to(run, box.cut_to, kBothAxes, feed);
  feed_to(run, box.out, kBothAxes, feed);
  rapid_to(run, box.start, kBothAxes);
  return true;
}

double word_or_zero(const Run& run, Address address) {
  return run.block.words.has(address) ? run.block.words[address] : 0;
}

void keep_end(Run& run, const Point& end) {
  run.parameters[kEndPoint] = end.z - run.state.origin.z;
  run.parameters[kDiameter] = (end.x - run.state.origin.x) * 2;
}

}  // namespace

bool cut_turning_box(Run& run) {
  Target target;
  if (!read_cycle_target(run, target)) return false;
  const Point start = run.state.position;
  const Point& end = target.to;
  const double taper = word_or_zero(run, Address::I);
  keep_end(run, end);
  run.parameters[kTurningTaper] = taper;
  run.parameters[kCutLength] = std::fabs(end.z - start.z);
  run.parameters[kCutDepth] = std::fabs(end.x - start.x);
  return cut(run, {start, {end.x + taper, start.z}, end, {start.x, end.z}});
}

bool cut_facing_box(Run& run) {
  Target target;
  if (!read_cycle_target(run, target)) return false;
  const Point start = run.state.position;
  const Point& end = target.to;
  const double taper = word_or_zero(run, Address::K);
  keep_end(run, end);
  run.parameters[kFacingTaper] = taper;
  run.parameters[kCutLength] = std::fabs(end.x - start.x);
  run.parameters[kCutDepth] = std::fabs(end.z - start.z);
  return cut(run, {start, {start.x, end.z + taper}, end, {end.x, start.z}});
}

namespace {

/// One hole. Levels are Z of the work.
struct Hole {
  double x = 0;  ///< radius
  double initial = 0;
  double clearance = 0;
  double bottom = 0;
  double dwell = 0;
  Feed feed = Feed::per_minute(Length::mm(0));
};

struct Pecks {
  double first = 0;
  double increment = 0;
  double clearance = 0;
};

unsigned cycle_code(const Run& run) {
  return run.axis_code();
}

bool read_hole(Run& run, Hole& hole) {
  const Point at = cycle_position(run);
  hole.x = at.x;
  hole.initial = at.z;
  run.parameters[kInitialLevel] = at.z;
  hole.clearance = cycle_position_word(run, Address::R, kClearanceZ, hole.initial);
  hole.bottom = cycle_position_word(run, Address::Z, kFinalDepth, hole.clearance);
  if (!check_target(run, {0, hole.clearance}) || !check_target(run, {0, hole.bottom})) return false;
  return cycle_feed_word(run, hole.feed);
}

void rapid_z(Run& run, const Hole& hole, double z) {
  cycle_rapid(run, {hole.x, z});
}
void feed_z(Run& run, const Hole& hole, double z) {
  cycle_feed(run, {hole.x, z}, hole.feed);
}

void go_to_clearance(Run& run, const Hole& hole) {
  cycle_rapid_to_clearance(run, {hole.x, hole.clearance});
}

double return_level(const Run& run, const Hole& hole) {
  return run.state.modes.returns_to_clearance ? hole.clearance : hole.initial;
}
void return_rapid(Run& run, const Hole& hole) {
  rapid_z(run, hole, return_level(run, hole));
}
/// Feed out to the clearance; the rest is rapid.
void return_feed(Run& run, const Hole& hole) {
  feed_z(run, hole, hole.clearance);
  return_rapid(run, hole);
}

/// G81, G82, G85, G89.
void drill(Run& run, const Hole& hole, bool feeds_out) {
  go_to_clearance(run, hole);
  feed_z(run, hole, hole.bottom);
  cycle_dwell(run, hole.dwell);
  if (feeds_out) return return_feed(run, hole);
  return_rapid(run, hole);
}

/// The first depth is a level of its own; without V it is one increment below the clearance.
bool read_pecks(Run& run, const Hole& hole, Pecks& pecks) {
  if (!(hole.bottom < hole.clearance)) {
    return run.fail(
        ErrorCode::ParameterOutOfRange, 0,
        fmt::format("G83 drills toward -Z: Z{} is not below R{}", hole.bottom, hole.clearance));
  }
  if (!cycle_step_word(run, Address::Q, kPeckIncrement, pecks.increment)) return false;
  if (!cycle_length_word(run, Address::E, kPeckClearance, pecks.clearance)) return false;
  if (!run.block.words.has(Address::V)) {
    run.parameters[kFirstDepth] = hole.clearance - pecks.increment;
  }
  pecks.first = cycle_position_word(run, Address::V, kFirstDepth, hole.clearance);
  if (!(pecks.first < hole.clearance)) {
    return run.fail(ErrorCode::ParameterOutOfRange, run.block.words.column(Address::V),
                    fmt::format("V{} is not below R{}", pecks.first, hole.clearance));
  }
  return true;
}

/// G83: out to the clearance after each peck, back in rapid to E above the depth reached.
bool drill_in_pecks(Run& run, const Hole& hole) {
  Pecks pecks;
  if (!read_pecks(run, hole, pecks)) return false;
  constexpr double kSame = 1e-9;
  const double left = std::max(0.0, pecks.first - hole.bottom);
  const double more = std::ceil(left / pecks.increment - kSame);
  if (!check_cycle_length(run, 3 * more + 3)) return false;
  go_to_clearance(run, hole);
  double depth = std::max(pecks.first, hole.bottom);
  feed_z(run, hole, depth);
  for (double peck = 1; peck <= more; ++peck) {
    rapid_z(run, hole, hole.clearance);
    rapid_z(run, hole, std::min(depth + pecks.clearance, hole.clearance));
    depth = peck == more ? hole.bottom : pecks.first - peck * pecks.increment;
    feed_z(run, hole, depth);
  }
  return_rapid(run, hole);
  return true;
}

bool refuse_tap(Run& run, const char* why) {
  return run.fail(ErrorCode::IllegalStatement, 0, why);
}

/// How far the tap advances while the spindle stops: half of the distance at full speed.
double coasting(const Run& run) {
  const double revolutions = run.state.spindle.revolutions / 60 * run.options.tap_ramp_seconds / 2;
  return revolutions * run.parameters[kCycleFeed];
}

SpindleState reverse_of(SpindleState state) {
  return state == SpindleState::Clockwise ? SpindleState::Counterclockwise
                                          : SpindleState::Clockwise;
}

/// G84: the feed is the lead. M3 cuts right-hand threads, M4 left-hand ones.
bool tap(Run& run, const Hole& hole) {
  const SpindleState direction = run.state.spindle.state;
  if (run.state.modes.is_surface_speed) return refuse_tap(run, "G84 needs G97");
  if (!run.state.modes.is_feed_per_revolution) return refuse_tap(run, "G84 needs G99");
  if (direction == SpindleState::Off) return refuse_tap(run, "G84 needs M3 or M4");
  if (!(run.state.spindle.revolutions > 0))
    return run.fail(ErrorCode::SpindleOutOfRange, 0, "G84 needs S");
  const double length = hole.bottom - hole.clearance;
  const double coast = coasting(run);
  if (!(coast < std::fabs(length))) {
    return run.fail(
        ErrorCode::ParameterOutOfRange, 0,
        fmt::format("the tap coasts {} and the thread is {} long", coast, std::fabs(length)));
  }
  go_to_clearance(run, hole);
  run.events().on_override_inhibit(tapping_lock(run.origin));
  feed_z(run, hole, hole.bottom - std::copysign(coast, length));
  spindle_to(run, reverse_of(direction));
  feed_z(run, hole, hole.clearance);
  spindle_to(run, direction);
  run.events().on_override_inhibit(lock_after_tap(override_inhibit(run)));
  return_rapid(run, hole);
  run.events().on_override_inhibit(override_inhibit(run));
  return true;
}

/// G86 starts the spindle and stops it at the bottom.
bool bore_with_stop(Run& run, const Hole& hole) {
  const SpindleModes& spindle = run.state.spindle;
  const double speed = run.state.modes.is_surface_speed ? spindle.surface : spindle.revolutions;
  if (!(speed > 0)) return run.fail(ErrorCode::SpindleOutOfRange, 0, "G86 needs S");
  if (spindle.state != SpindleState::Clockwise) spindle_to(run, SpindleState::Clockwise);
  go_to_clearance(run, hole);
  feed_z(run, hole, hole.bottom);
  spindle_to(run, SpindleState::Off);
  return_rapid(run, hole);
  return true;
}

bool make_hole(Run& run) {
  Hole hole;
  if (!read_hole(run, hole)) return false;
  const unsigned code = cycle_code(run);
  if (code == 84) return tap(run, hole);
  if (code == 86) return bore_with_stop(run, hole);
  if ((code == 82 || code == 89) && !cycle_dwell_word(run, hole.dwell)) return false;
  if (!check_cycle_spindle(run)) return false;
  if (code == 83) return drill_in_pecks(run, hole);
  drill(run, hole, code == 85 || code == 89);
  return true;
}

}  // namespace

bool run_drilling_cycle(Run& run) {
  return run_canned_cycle(run, make_hole);
}

}  // namespace dripline::interpreter::centurion
