#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/execution.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/turning.hpp"

/// The line of a lathe cycle, and the lines of its contour (LinuxCNC: G70, G71 G72).
namespace dripline::interpreter::rs274ngc {
namespace {

bool refuse_cycle(Run& run, std::string_view why) {
  const int code = run.block.motion;
  return run.fail(ErrorCode::TurningWords, 0,
                  code % 10 == 0 ? fmt::format("G{}: {}", code / 10, why)
                                 : fmt::format("G{}.{}: {}", code / 10, code % 10, why));
}

bool check_modes(Run& run) {
  const State& state = run.state;
  if (state.modes.plane != Plane::ZX || state.modes.has_tilted_plane)
    return refuse_cycle(run, "needs G18");
  if (state.compensation.side != Side::Off) {
    return run.fail(ErrorCode::CompNotAllowed, 0, "a lathe cycle");
  }
  if (state.rotation != 0)
    return run.fail(ErrorCode::NotSupported, 0, "a lathe cycle in a turned system");
  if (state.modes.feed == FeedMode::InverseTime) return refuse_cycle(run, "not with G93");
  if (state.turning.code != 0) return refuse_cycle(run, "within the contour of another");
  return true;
}

bool check_words(Run& run) {
  const Words& words = run.block.words;
  if (words.has_any(set_of("YABCUVW@^")))
    return refuse_cycle(run, "takes X and Z alone of the axes");
  // Their meaning for these words is any.
  for (const GGroup group : {GGroup::OneShot, GGroup::Lathe, GGroup::Distance, GGroup::Units}) {
    if (run.block.has(group)) return refuse_cycle(run, "with another code on its line");
  }
  if (run.block.has(MGroup::Stop)) return refuse_cycle(run, "with a stop or a call on its line");
  const double label = words.value_or('Q', -1);
  constexpr double kMaxLabel = 1e9;
  if (!(label >= 0 && label <= kMaxLabel) || label != std::floor(label))
    return refuse_cycle(run, "needs Q, the number of a subprogram");
  return true;
}

/// D, E, I, R are radii whatever G7 says.
bool read_cycle(Run& run, TurningCycle& cycle) {
  constexpr double kIncrement = 1, kRetract = 0.5;  // units of the program
  const Words& words = run.block.words;
  cycle.distance = run.mm(words.value_or('D', 0));
  cycle.last_distance = run.mm(words.value_or('E', 0));
  cycle.increment = run.mm(words.value_or('I', kIncrement));
  cycle.retract = run.mm(words.value_or('R', kRetract));
  const double passes = words.value_or('P', 1);
  if (!(cycle.distance >= 0 && cycle.last_distance >= 0 && cycle.retract >= 0))
    return refuse_cycle(run, "D, E or R is below 0");
  if (!(cycle.increment > 0)) return refuse_cycle(run, "I is not above 0");
  if (!(passes >= 1 && passes <= kMaxFinishingPasses) || passes != std::floor(passes))
    return refuse_cycle(run,
                        fmt::format("P is not a whole number from 1 to {}", kMaxFinishingPasses));
  cycle.passes = static_cast<int>(passes);
  return true;
}

// The contour.

bool refuse_line(Run& run, std::string_view why) {
  return run.fail(ErrorCode::TurningContour, 0, why);
}

/// A code that says what is in force already.
bool restates(const Run& run, GGroup group) {
  const Modes& modes = run.state.modes;
  const int code = run.block.g(group);
  switch (group) {
    case GGroup::Plane:
      return code == 180;
    case GGroup::Distance:
      return (code == 910) == modes.is_incremental;
    case GGroup::ArcDistance:
      return (code == 901) == modes.is_arc_absolute;
    case GGroup::Units:
      return (code == 200) == (run.state.units == Units::Inch);
    case GGroup::Lathe:
      return (code == 70) == modes.is_diameter;
    case GGroup::Radius:
      return code == 400;
    default:
      return false;
  }
}

/// The control passes over all but motions; here that is so of what cannot change the path.
bool check_codes(Run& run) {
  const Block& block = run.block;
  for (std::size_t i = 0; i < kGGroups; ++i) {
    const auto group = static_cast<GGroup>(i);
    if (group == GGroup::Motion || !block.has(group) || restates(run, group)) continue;
    return refuse_line(run, fmt::format("G{} within it", block.g(group) / 10.0));
  }
  if (block.has(MGroup::Stop))
    return refuse_line(run, fmt::format("M{} within it", block.m(MGroup::Stop)));
  TurningCycle& cycle = run.state.turning;
  if ((block.m_groups != 0 || block.words.has_any(set_of("FST"))) && !cycle.has_warned) {
    cycle.has_warned = true;
    run.warn(kContourWords, "F, S, T and M words in the contour of a lathe cycle do nothing");
  }
  return true;
}

/// One coordinate of the end: X or Z, or U or W, which count from the present one.
bool read_coordinate(Run& run, char absolute, char increment, double& at) {
  const Words& words = run.block.words;
  if (words.has(increment)) {
    if (run.state.modes.is_incremental || words.has(absolute))
      return refuse_line(run, fmt::format("{} with G91 or {}", increment, absolute));
    const bool is_diameter = increment == 'U' && run.state.modes.is_diameter;
    at += run.mm(words[increment]) / (is_diameter ? 2 : 1);
  } else if (words.has(absolute)) {
    at = run.mm(words[absolute]) + (run.state.modes.is_incremental ? at : 0);
  }
  return true;
}

bool read_corner(Run& run, ContourMove& move) {
  const Words& words = run.block.words;
  if (!words.has_any(set_of("AC"))) return true;
  if (words.has('A') && words.has('C')) return refuse_line(run, "A and C at one corner");
  move.is_chamfer = words.has('C');
  move.corner = run.mm(words[move.is_chamfer ? 'C' : 'A']);
  return move.corner > 0 || refuse_line(run, "A or C is not above 0");
}

bool read_move(Run& run, PlaneVector from, ContourMove& move) {
  const int code = run.block.motion;
  const Words& words = run.block.words;
  if (words.has_any(set_of("YBV@^P"))) return refuse_line(run, "a word that its moves do not take");
  move.to = from;
  if (!read_coordinate(run, 'Z', 'W', move.to.first) ||
      !read_coordinate(run, 'X', 'U', move.to.second) || !read_corner(run, move)) {
    return false;
  }
  move.is_arc = code == 20 || code == 30;
  move.is_counterclockwise = code == 30;
  if (!move.is_arc) return true;
  if (words.has('R') && words['R'] < 0) return refuse_line(run, "an arc above half a circle");
  const Turn turn = move.is_counterclockwise ? Turn::Counterclockwise : Turn::Clockwise;
  return arc_center(run, from, move.to, turn, move.center);
}

}  // namespace

bool begin_turning(Run& run) {
  TurningCycle cycle;
  Target target;
  Feed feed;
  if (!check_modes(run) || !check_words(run) || !read_cycle(run, cycle) ||
      !read_feed(run, false, feed) || !read_target(run, target)) {
    return false;
  }
  if (run.state.compensation.was_on) return refuse_cycle(run, "needs a move after G40");
  rapid_to(run, target);
  cycle.code = static_cast<std::int16_t>(run.block.motion);
  cycle.level = static_cast<std::uint32_t>(run.state.calls.size());
  cycle.line = run.here;
  cycle.start = tool_point(run);
  run.state.turning = std::move(cycle);
  return true;
}

bool record_contour_line(Run& run) {
  State& state = run.state;
  Block& block = run.block;
  if (!check_codes(run)) return false;
  if (block.setting_count != 0) apply_settings(run);
  if (block.motion < 0) return true;
  if (block.motion > 30) return refuse_line(run, fmt::format("G{} within it", block.motion / 10.0));
  state.modes.motion = static_cast<std::int16_t>(block.motion);
  constexpr AddressSet kOfMoves = kAxisWords | kPolarWords | set_of("IJKRP");
  if (!block.words.has_any(kOfMoves)) return true;
  ContourMove move;
  const PlaneVector from = tool_point(run);
  if (!read_move(run, from, move)) return false;
  auto& moves = state.turning.moves;
  if (move.to == from) {
    if (!move.is_arc && move.corner == 0) return true;
    return refuse_line(run, "a full circle, or a corner without a move");
  }
  if (moves.empty() && move.is_arc) return refuse_line(run, "it begins with an arc");
  if (moves.size() == kMaxContourMoves)
    return refuse_line(run, fmt::format("more than {} moves", kMaxContourMoves));
  moves.push_back(move);
  state[Axis::Z] = move.to.first;
  state[Axis::X] = move.to.second;
  return true;
}

void end_recording(Run& run) {
  State& state = run.state;
  state[Axis::Z] = state.turning.start.first;
  state[Axis::X] = state.turning.start.second;
  state.turning = {};
}

}  // namespace dripline::interpreter::rs274ngc
