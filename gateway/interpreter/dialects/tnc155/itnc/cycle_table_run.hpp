#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/cycle_tables.hpp"

namespace dripline::interpreter::tnc155::itnc {

enum Cycle : std::uint16_t {
  kDrill = 200,
  kReam = 201,
  kBore = 202,
  kUniversal = 203,
  kBackBore = 204,
  kPeck = 205,
  kTap = 206,
  kRigidTap = 207,
  kBoreMill = 208,
  kChipTap = 209,
  kCenter = 240,
  kRectangularPocket = 251,
  kCircularPocket = 252,
  kSlot = 253,
  kRoundSlot = 254,
  kThread = 262
};
/// One that a pattern repeats.
constexpr bool is_at_a_point(int cycle) {
  return (cycle >= kDrill && cycle <= kChipTap) || cycle == kCenter ||
         (cycle >= kRectangularPocket && cycle <= kSlot) || cycle == kThread;
}
/// The spindle runs with the feed, and the cycle starts it itself.
constexpr bool is_rigid(int cycle) {
  return cycle == kRigidTap || cycle == kChipTap;
}

/// The words of the cycle, and the moves in the tool axis.
class Table {
 public:
  /// `last`: the height after the cycle, where a pattern has another one than the cycle itself.
  explicit Table(Run& run, std::optional<double> last = {})
      : run_(run),
        rows_(cycle_table(run.state.cycle.machining.number)),
        unit_(run.state.mm_per_unit()),
        last_(last) {}

  /// As programmed; 0 for one that this control's definition has not.
  double of(int q) const { return value_of(rows_, run_.state.cycle_words, q); }
  double mm(int q) const { return of(q) * unit_; }
  /// Millimeters per minute; F of an inch program is tenths of an inch.
  double feed(int q) const {
    constexpr double kTenths = 10;
    return run_.state.units == Units::Inch ? of(q) * Length::kMillimetersPerInch / kTenths : of(q);
  }
  double surface() const { return mm(203); }
  double clearance() const { return surface() + mm(200); }
  double bottom() const { return surface() + mm(201); }
  double last() const { return last_.value_or(std::max(clearance(), surface() + mm(204))); }
  /// The word that says how deep the cycle goes: 0 does nothing.
  double depth() const { return of(run_.state.cycle.machining.number == kBackBore ? 249 : 201); }

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
    arrive(state, target);
  }
  /// In the working plane, at a feed.
  void shift(PlaneVector by, double feed) const {
    const PlaneAxes axes = axes_of(run_.state.plane);
    Target target = here(run_.state);
    target.set(axes.first, target.at[index(axes.first)] + by.first);
    target.set(axes.second, target.at[index(axes.second)] + by.second);
    line_to(run_, target, {feed == 0, feed, feed});
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
  std::optional<double> last_;
};

// Conditions of a call; false: the run has failed.

/// No parameter `but` these was changed since the definition: whether the control takes that over
/// is not stated.
bool check_unchanged(Run& run, std::span<const int> but);
/// Tool and spindle, and no parameter changed since the definition.
bool check_ready(Run& run, int cycle);
/// How many infeeds a call comes to, about.
double passes_of(const Table& table);
/// Signs, sizes, feeds and a bounded number of moves.
bool check_values(Run& run, const Table& table, int cycle);
/// Everything before the first move of a call. `is_idle`: depth 0, nothing is to be done.
bool check_call(Run& run, const Table& table, bool& is_idle);
/// The moves of one call, after the checks.
void make_cycle(const Table& table, int cycle);
/// Whether `moves` would stay within the limits; it is made without output.
template <class Moves>
bool stays_within_limits(Run& run, const Moves& moves) {
  if (!run.limits.has_any() || run.tilted.is_on()) return true;
  const Position machine = run.state.machine;
  const AxisValues nominal = run.state.nominal, beside = run.state.beside;
  const bool is_beside = run.state.is_beside;
  run.is_measuring = true;
  moves();
  run.is_measuring = false;
  run.state.machine = machine;
  run.state.nominal = nominal;
  run.state.beside = beside;
  run.state.is_beside = is_beside;
  return !run.limits.reached();
}
/// The last definition was a pattern: its points, and the cycle at each of them.
bool run_pattern(Run& run, int pattern, const std::vector<double>& words);

}  // namespace dripline::interpreter::tnc155::itnc
