#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/later/cycle_tables.hpp"
#include "gateway/interpreter/dialects/tnc155/later/later_execution.hpp"

/// Cycles 200 to 208. Source: iTNC 530 (and TNC 426/430), User's Manual, Cycles: drilling, tapping
/// and thread milling; the steps of each are in this folder's README.
namespace dripline::interpreter::tnc155::later {
namespace {

enum Cycle : std::uint8_t {
  kDrill = 200,
  kReam = 201,
  kUniversal = 203,
  kPeck = 205,
  kTap = 206,
  kRigidTap = 207,
  kBoreMill = 208
};

constexpr double kMaxPasses = 2000;

/// The words of the cycle, and the moves in the tool axis.
class Table {
 public:
  explicit Table(Run& run)
      : run_(run),
        rows_(cycle_table(run.state.cycle.machining.number)),
        unit_(run.state.mm_per_unit()) {}

  /// As programmed; 0 for one that this control's definition has not.
  double of(int q) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].q == q) return run_.state.cycle_words[i];
    }
    return 0;
  }
  double mm(int q) const { return of(q) * unit_; }
  /// Millimeters per minute; F of an inch program is tenths of an inch.
  double feed(int q) const {
    constexpr double kTenths = 10;
    return run_.state.units == Units::Inch ? of(q) * Length::kMillimetersPerInch / kTenths : of(q);
  }
  double surface() const { return mm(203); }
  double clearance() const { return surface() + mm(200); }
  double bottom() const { return surface() + mm(201); }
  double last() const { return std::max(clearance(), surface() + mm(204)); }

  void rapid(double height) const { move(height, kRapid); }
  void cut(double height, double feed) const { move(height, {false, feed, feed}); }
  /// Out of the hole at Q208; 0: at the feed into it.
  void retract(double height) const {
    if (of(kRetractionFeed) >= kRapidFeed) return rapid(height);
    cut(height, feed(of(kRetractionFeed) > 0 ? kRetractionFeed : 206));
  }
  void dwell(double seconds) const {
    if (seconds > 0 && !run_.is_measuring) run_.events().on_dwell({run_.origin, seconds, {}});
  }
  void turn(SpindleState state) const {
    if (!run_.is_measuring) turn_spindle(run_, state);
  }
  void thread(double height, double pitch) const {
    if (run_.is_measuring) return cut(height, 1);
    State& state = run_.state;
    Target target = here(state);
    target.set(state.tool.axis, height);
    Thread event;
    event.origin = run_.origin;
    event.to = machine_position(state, target);
    event.lead = Length::mm(std::fabs(pitch));
    if (event.to.same_point(state.machine)) return;
    run_.loops.note_progress();
    run_.events().on_thread(event);
    state.machine = event.to;
    state.nominal = target.at;
  }
  Run& run() const { return run_; }

 private:
  void move(double height, Pace pace) const {
    Target target = here(run_.state);
    target.set(run_.state.tool.axis, height);
    line_to(run_, target, pace);
  }
  Run& run_;
  std::span<const CycleParameter> rows_;
  double unit_;
};

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

/// The spindle stands still afterward.
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

/// Half a circle out to the wall at the clearance, down in a helix, once around at the bottom, and
/// half a circle back to the center.
void mill_bore(const Table& table) {
  Run& run = table.run();
  State& state = run.state;
  const PlaneAxes axes = axes_of(state.plane);
  const PlaneVector center = nominal_in_plane(state);
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
  const double turns = (table.clearance() - table.bottom()) / table.mm(334);
  const double sweep = turns * kFull;
  const double end = (turn == Turn::Counterclockwise ? 1 : -1) * sweep;
  const PlaneVector out = unit_vector(end);
  const PlaneVector at = center + radius * out;
  arc(at, center, table.bottom(), sweep);
  arc(at, center, table.bottom(), kFull);
  arc(center, center + (radius / 2) * out, table.bottom(), kHalf);
  table.rapid(table.last());
}

void make(const Table& table, int cycle) {
  table.rapid(table.clearance());
  switch (cycle) {
    case kDrill:
      return drill(table);
    case kReam:
      return ream(table);
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

/// Programs may set Q200 and above after the definition: whether the control takes that over is not
/// stated.
bool check_unchanged(Run& run) {
  const auto rows = cycle_table(run.state.cycle.machining.number);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double now = run.state.q[static_cast<std::size_t>(rows[i].q)];
    if (now == run.state.cycle_words[i]) continue;
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("Q{} was changed from {} to {} after CYCL DEF {}", rows[i].q,
                                run.state.cycle_words[i], now, run.state.cycle.machining.number));
  }
  return true;
}

bool check_spindle(Run& run, int cycle) {
  const State& state = run.state;
  if (!state.tool.is_called || !state.spindle.has_speed) {
    return run.fail(ErrorCode::ToolCallMissing, "a cycle needs TOOL CALL with axis and S");
  }
  if (cycle == kRigidTap || state.spindle.state != SpindleState::Off) return true;
  return run.fail(ErrorCode::SpindleRotatesMissing, "M3 or M4 before a cycle");
}

bool check_bore(Run& run, const Table& table) {
  const State& state = run.state;
  const double diameter = 2 * state.tool.data.radius / state.transformation.factor(state.plane);
  if (!check_circle_plane(run)) return false;
  constexpr double kSame = 1e-6;
  if (!(diameter > 0) || table.mm(335) < diameter - kSame) {
    return run.fail(ErrorCode::ToolRadiusTooLarge,
                    fmt::format("bore {:.4f} mm, tool {:.4f} mm", table.mm(335), diameter));
  }
  if (table.mm(342) == 0 && table.mm(335) > 2 * diameter + kSame) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("bore {:.4f} mm is more than two tools of {:.4f} mm, and Q342 is 0",
                                table.mm(335), diameter));
  }
  if (table.of(351) != 0 && std::fabs(table.of(351)) != 1) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q351 {}", table.of(351)));
  }
  return true;
}

/// Depth below the surface, infeeds, feeds, and a bounded number of moves.
bool check_values(Run& run, const Table& table, int cycle) {
  const auto wrong = [&](int q, std::string_view what) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q{} {} {}", q, table.of(q), what));
  };
  if (table.of(201) > 0) return wrong(201, "is above the surface");
  if (cycle != kRigidTap && !(table.of(206) > 0)) return wrong(206, "is no feed");
  if (cycle == kRigidTap && table.of(239) == 0) return wrong(239, "is no pitch");
  const double depth = -table.of(201);
  double passes = 1;
  if (cycle == kDrill || cycle == kUniversal || cycle == kPeck) {
    if (!(table.of(202) > 0)) return wrong(202, "is no infeed");
    double least = table.of(202);
    if (table.of(212) > 0) {
      if (!(table.of(205) > 0)) return wrong(205, "is no least infeed, and Q212 makes it smaller");
      least = std::min(least, table.of(205));
    }
    if (table.of(257) > 0) least = std::min(least, table.of(257));
    passes = depth / least;
  }
  if (cycle == kUniversal && table.of(213) > 0 && !(table.of(256) > 0)) {
    return wrong(256, "is no way back to break chips");
  }
  if (cycle == kBoreMill) {
    if (!(table.of(334) > 0)) return wrong(334, "is no infeed");
    passes = depth / table.of(334);
    if (!check_bore(run, table)) return false;
  }
  if (passes <= kMaxPasses) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("CYCL DEF {} would be {:.0f} infeeds, at most {:.0f}", cycle, passes,
                              kMaxPasses));
}

bool stays_within_limits(Run& run, const Table& table, int cycle) {
  if (!run.limits.has_any()) return true;
  const Position machine = run.state.machine;
  const AxisValues nominal = run.state.nominal;
  run.is_measuring = true;
  make(table, cycle);
  run.is_measuring = false;
  run.state.machine = machine;
  run.state.nominal = nominal;
  return !run.limits.reached();
}

bool is_allowed(CycleUse use, double value) {
  switch (use) {
    case CycleUse::Distance:
    case CycleUse::Feed:
    case CycleUse::Seconds:
      return value >= 0;
    case CycleUse::Zero:
      return value == 0;
    default:
      return true;
  }
}

}  // namespace

bool define_table(Run& run, const Block& block) {
  State& state = run.state;
  const auto rows = cycle_table(block.cycle);
  std::vector<double> values(rows.size());
  for (const CycleWord& word : run.parts.later.words) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].q != word.parameter) continue;
      double value = run.number(word.value);
      if (word.is_rapid) value = kRapidFeed;
      if (word.is_auto) {
        if (!(state.tool_feed > 0)) {
          return run.fail(ErrorCode::FeedRateMissing, "FAUTO, and TOOL CALL had no F");
        }
        value =
            state.tool_feed * (state.units == Units::Inch ? 10 / Length::kMillimetersPerInch : 1);
      }
      if (!is_allowed(rows[i].use, value)) {
        return run.fail(
            rows[i].use == CycleUse::Zero ? ErrorCode::NotSupported : ErrorCode::EntryOutOfRange,
            fmt::format("Q{} = {} in CYCL DEF {}", rows[i].q, value, block.cycle));
      }
      values[i] = value;
    }
  }
  constexpr int kPreset = 247;
  if (block.cycle == kPreset) {
    const double preset = values[0];
    if (preset != static_cast<int>(preset)) {
      return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q339 = {}", preset));
    }
    state.q[339] = preset;
    return use_preset(run, static_cast<int>(preset));
  }
  // The words of a definition are what the parameters hold from then on.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    state.q[static_cast<std::size_t>(rows[i].q)] = values[i];
  }
  state.cycle_words = std::move(values);
  state.cycle.machining = MachiningCycle{};
  state.cycle.machining.number = block.cycle;
  return true;
}

double clearance_height(Run& run) {
  return Table(run).clearance();
}

bool run_table(Run& run) {
  State& state = run.state;
  const int cycle = state.cycle.machining.number;
  if (!refuse_before_positioning(run, "a cycle call") || !check_unchanged(run)) return false;
  if (state.is_compensating() || state.is_parallel || state.blend.kind != BlendKind::None) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    fmt::format("cycle {} within a contour: R0 before it", cycle));
  }
  const Table table(run);
  if (!check_spindle(run, cycle)) return false;
  if (table.of(201) == 0) {
    run.warn("TNC-ACCEPTED", fmt::format("cycle {} has depth 0 and does nothing", cycle));
    return true;
  }
  if (!check_values(run, table, cycle)) return false;
  if (run.blend_follows) {
    return run.fail(ErrorCode::PlaneWronglyDefined, "RND or CHF after a cycle call");
  }
  if (!stays_within_limits(run, table, cycle)) return run.fail_at_limit();
  interrupt_contour(run);
  make(table, cycle);
  state.last = LastMove{};
  state.polar.is_current = false;
  return true;
}

}  // namespace dripline::interpreter::tnc155::later
