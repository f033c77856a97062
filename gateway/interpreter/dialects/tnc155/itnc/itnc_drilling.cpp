#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/cycle_table_run.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/milling.hpp"

/// Cycles 200 to 209 and 240. Source: iTNC 530 (and TNC 426/430), User's Manual, Cycles: drilling,
/// tapping and thread milling; the steps of each are in this folder's README.
namespace dripline::interpreter::tnc155::itnc {
namespace {

void drill(const Table& table) {
  double depth = table.surface();
  while (depth > table.bottom()) {
    const bool is_first = depth == table.surface();
    if (!is_first) {
      table.rapid(table.clearance());
      table.dwell(table.of(210));
      table.rapid(std::min(table.clearance(), depth + table.mm(200)));
    }
    depth = std::max(table.bottom(), depth - table.mm(202));
    table.cut(depth, table.feed(206));
  }
  table.dwell(table.of(211));
  table.rapid(table.last());
}

void ream(const Table& table) {
  table.cut(table.bottom(), table.feed(206));
  table.dwell(table.of(211));
  table.retract(table.clearance());
  table.rapid(table.last());
}

void center(const Table& table) {
  table.cut(table.bottom(), table.feed(206));
  table.dwell(table.of(211));
  table.rapid(table.last());
}

/// Away from the wall, in the direction of Q214: 1 to 4 are the negative and positive first and
/// second axis; see the README for the return path.
PlaneVector disengagement(const Table& table, double distance) {
  const int direction = static_cast<int>(table.of(214));
  const double by = direction == 1 || direction == 2 ? -distance : distance;
  if (direction == 0) return {};
  return direction % 2 == 1 ? PlaneVector{by, 0} : PlaneVector{0, by};
}

void bore(const Table& table) {
  const SpindleState direction = table.run().state.spindle.state;
  table.cut(table.bottom(), table.feed(206));
  table.dwell(table.of(211));
  table.turn(SpindleState::Oriented);
  constexpr double kOffTheWall = 0.2;
  const PlaneVector away = disengagement(table, kOffTheWall);
  const double retraction = table.feed(table.of(208) > 0 ? 208 : 206);
  if (table.of(214) > 0) table.shift(away, retraction);
  table.retract(table.clearance());
  table.rapid(table.last());
  if (table.of(214) > 0) table.shift({-away.first, -away.second}, 0);
  table.turn(direction);
}

/// From below. The length of the tool is that of its underside, and the tooth is Q252 above it (TNC
/// 426 and iTNC 530, User's Manuals: back boring, tool edge height).
void bore_back(const Table& table) {
  const SpindleState direction = table.run().state.spindle.state;
  const double in_and_out = table.feed(253);
  const double underside = table.surface() - table.mm(250) - table.mm(252);
  const double below = underside - table.mm(200);
  const PlaneVector aside = disengagement(table, table.mm(251));
  const PlaneVector back{-aside.first, -aside.second};
  table.turn(SpindleState::Oriented);
  table.shift(aside, in_and_out);
  table.cut(below, in_and_out);
  table.shift(back, in_and_out);
  table.turn(direction);
  table.cut(underside + table.mm(249), table.feed(254));
  table.dwell(table.of(255));
  table.cut(below, in_and_out);
  table.turn(SpindleState::Oriented);
  table.shift(aside, in_and_out);
  table.cut(table.clearance(), in_and_out);
  table.rapid(table.last());
  table.shift(back, 0);
  table.turn(direction);
}

/// Infeeds become smaller by Q212, down to Q205.
double next_infeed(const Table& table, double infeed) {
  return std::max(infeed - table.mm(212), std::min(infeed, table.mm(205)));
}

void drill_universally(const Table& table) {
  const int breaks = static_cast<int>(table.of(213));
  double infeed = table.mm(202);
  double depth = table.surface();
  int broken = 0;
  while (depth > table.bottom()) {
    depth = std::max(table.bottom(), depth - infeed);
    table.cut(depth, table.feed(206));
    if (!(depth > table.bottom())) break;
    if (broken < breaks) {
      ++broken;
      table.retract(std::min(table.clearance(), depth + table.mm(256)));
    } else {
      broken = 0;
      table.retract(table.clearance());
      table.dwell(table.of(210));
      table.rapid(std::min(table.clearance(), depth + table.mm(200)));
    }
    infeed = next_infeed(table, infeed);
  }
  table.dwell(table.of(211));
  table.retract(table.clearance());
  table.rapid(table.last());
}

/// With Q257 the chip is broken within an infeed.
void cut_with_breaks(const Table& table, double from, double to) {
  const double step = table.mm(257);
  for (double at = from; step > 0 && at - step > to;) {
    at -= step;
    table.cut(at, table.feed(206));
    table.rapid(std::min(table.clearance(), at + table.mm(256)));
  }
  table.cut(to, table.feed(206));
}

void peck(const Table& table) {
  const double total = table.surface() - table.bottom();
  double infeed = table.mm(202);
  double depth = table.surface();
  while (depth > table.bottom()) {
    if (depth < table.surface()) {
      // The advanced stop distance goes evenly from that of the first to that of the last infeed.
      const double share = (table.surface() - depth) / total;
      const double distance = table.mm(258) + share * (table.mm(259) - table.mm(258));
      table.rapid(table.clearance());
      table.rapid(std::min(table.clearance(), depth + distance));
      infeed = next_infeed(table, infeed);
    }
    const double next = std::max(table.bottom(), depth - infeed);
    cut_with_breaks(table, depth, next);
    depth = next;
  }
  table.dwell(table.of(211));
  table.rapid(table.last());
}

SpindleState reversed(SpindleState state) {
  return state == SpindleState::Clockwise ? SpindleState::Counterclockwise
                                          : SpindleState::Clockwise;
}

void tap(const Table& table) {
  Run& run = table.run();
  const SpindleState direction = run.state.spindle.state;
  if (!run.is_measuring) run.events().on_override_inhibit(tapping_lock(run.origin));
  table.cut(table.bottom(), table.feed(206));
  table.turn(reversed(direction));
  table.dwell(table.of(211));
  table.cut(table.clearance(), table.feed(206));
  table.turn(direction);
  if (!run.is_measuring) run.events().on_override_inhibit({.origin = run.origin});
  table.rapid(table.last());
}

/// The spindle is stopped afterward.
void tap_rigidly(const Table& table) {
  Run& run = table.run();
  const SpindleState in =
      table.of(239) > 0 ? SpindleState::Clockwise : SpindleState::Counterclockwise;
  if (!run.is_measuring) run.events().on_override_inhibit(tapping_lock(run.origin));
  table.turn(in);
  table.thread(table.bottom(), table.mm(239));
  table.turn(reversed(in));
  table.thread(table.clearance(), table.mm(239));
  table.turn(SpindleState::Off);
  if (!run.is_measuring) run.events().on_override_inhibit({.origin = run.origin});
  table.rapid(table.last());
}

/// Each Q257 the thread is cut back by Q256 pitches, or out of the hole.
void tap_with_breaks(const Table& table) {
  Run& run = table.run();
  const SpindleState in =
      table.of(239) > 0 ? SpindleState::Clockwise : SpindleState::Counterclockwise;
  const double pitch = table.mm(239);
  const double back = table.of(256) * std::fabs(pitch);
  if (!run.is_measuring) run.events().on_override_inhibit(tapping_lock(run.origin));
  for (double depth = table.surface(); depth > table.bottom();) {
    const double step = table.mm(257) > 0 ? table.mm(257) : depth - table.bottom();
    depth = std::max(table.bottom(), depth - step);
    table.turn(in);
    table.thread(depth, pitch);
    table.turn(reversed(in));
    const bool is_last = !(depth > table.bottom());
    const bool leaves = is_last || back == 0;
    table.thread(leaves ? table.clearance() : std::min(table.clearance(), depth + back), pitch);
  }
  table.turn(SpindleState::Off);
  if (!run.is_measuring) run.events().on_override_inhibit({.origin = run.origin});
  table.rapid(table.last());
}

/// Half a circle out to the wall at the clearance, down in a helix, once around at the bottom, and
/// half a circle back to the center.
void mill_bore(const Table& table) {
  Run& run = table.run();
  State& state = run.state;
  const PlaneAxes axes = axes_of(state.plane);
  const PlaneVector center = in_plane(state, here(state));
  const double tool = state.tool.data.radius / state.transformation.factor(state.plane);
  const double radius = table.mm(335) / 2 - tool;
  const Pace pace{false, table.feed(206), table.feed(206)};
  constexpr double kSame = 1e-6;
  if (radius < kSame) {
    table.cut(table.bottom(), table.feed(206));
    return table.rapid(table.last());
  }
  const bool is_climb = table.of(351) >= 0;
  const bool is_mirrored = state.transformation.turns_over(state.plane);
  const Turn turn = is_climb != is_mirrored ? Turn::Counterclockwise : Turn::Clockwise;
  const auto arc = [&](PlaneVector to, PlaneVector about, double height, double sweep) {
    ArcTarget target;
    target.to = here(state);
    target.to.set(axes.first, to.first);
    target.to.set(axes.second, to.second);
    target.to.set(state.tool.axis, height);
    target.center = about;
    target.turn = turn;
    target.sweep = sweep;
    tnc155::arc_to(run, target, pace);
  };
  constexpr double kHalf = 180, kFull = 360;
  const PlaneVector wall = center + PlaneVector{radius, 0};
  const PlaneVector between = center + PlaneVector{radius / 2, 0};
  arc(wall, between, table.clearance(), kHalf);
  const double revolutions = (table.clearance() - table.bottom()) / table.mm(334);
  const double sweep = revolutions * kFull;
  const double end = (turn == Turn::Counterclockwise ? 1 : -1) * sweep;
  const PlaneVector out = unit_vector(end);
  const PlaneVector at = center + radius * out;
  arc(at, center, table.bottom(), sweep);
  arc(at, center, table.bottom(), kFull);
  arc(center, center + (radius / 2) * out, table.bottom(), kHalf);
  table.rapid(table.last());
}

}  // namespace

void make_cycle(const Table& table, int cycle) {
  if (is_pocket(cycle)) return mill_pocket(table, cycle);
  if (cycle == kThread) return mill_thread(table);
  table.rapid(table.clearance());
  switch (cycle) {
    case kDrill:
      return drill(table);
    case kReam:
      return ream(table);
    case kBore:
      return bore(table);
    case kBackBore:
      return bore_back(table);
    case kCenter:
      return center(table);
    case kChipTap:
      return tap_with_breaks(table);
    case kUniversal:
      return drill_universally(table);
    case kPeck:
      return peck(table);
    case kTap:
      return tap(table);
    case kRigidTap:
      return tap_rigidly(table);
    default:
      return mill_bore(table);
  }
}

double clearance_height(Run& run) {
  return Table(run).clearance();
}

bool check_call(Run& run, const Table& table, bool& is_idle) {
  const State& state = run.state;
  const int cycle = state.cycle.machining.number;
  if (!refuse_before_positioning(run, "a cycle call")) return false;
  if (!check_place_is_known(run)) return false;
  if (!check_tilted_cycle(run, "a cycle")) return false;
  if (state.is_compensating() || state.is_parallel || state.blend.kind != BlendKind::None) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    fmt::format("cycle {} within a contour: R0 before it", cycle));
  }
  if (!check_ready(run, cycle)) return false;
  is_idle = table.depth() == 0;
  if (is_idle) {
    run.warn("TNC-ACCEPTED", fmt::format("cycle {} has depth 0 and does nothing", cycle));
    return true;
  }
  if (!check_values(run, table, cycle)) return false;
  if (!run.blend_follows) return true;
  return run.fail(ErrorCode::PlaneWronglyDefined, "RND or CHF after a cycle call");
}

bool run_table(Run& run) {
  State& state = run.state;
  const int cycle = state.cycle.machining.number;
  const Table table(run);
  bool is_idle = false;
  if (!check_call(run, table, is_idle)) return false;
  if (is_idle) return true;
  if (!stays_within_limits(run, [&] { make_cycle(table, cycle); })) return run.fail_at_limit();
  interrupt_contour(run);
  make_cycle(table, cycle);
  state.last = LastMove{};
  state.polar.is_current = false;
  state.has_open_place = leaves_place_open(table, cycle);
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
