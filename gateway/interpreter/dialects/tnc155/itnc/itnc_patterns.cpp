#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/cycle_table_run.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/milling.hpp"

/// Cycles 220 and 221: they act where they are defined, and call the cycle that was defined before
/// them at each of their points (TNC 426, TNC 320 and iTNC 530, User's Manuals: point patterns).
namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr double kMaxPoints = 2'000;
/// Of a cycle with many infeeds: what one block may come to.
constexpr double kMaxPatternPasses = 20'000;

/// The words of a pattern.
class Pattern {
 public:
  Pattern(const Run& run, int cycle, const std::vector<double>& words)
      : rows_(cycle_table(cycle)), words_(words), unit_(run.state.mm_per_unit()) {}

  double of(int q) const { return value_of(rows_, words_, q); }
  double mm(int q) const { return of(q) * unit_; }

 private:
  std::span<const CycleParameter> rows_;
  const std::vector<double>& words_;
  double unit_;
};

bool is_count(double value) {
  return value >= 1 && value <= kMaxPoints && value == std::trunc(value);
}

bool wrong(Run& run, const Pattern& pattern, int q, std::string_view what) {
  return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q{} = {} {}", q, pattern.of(q), what));
}

bool check_count(Run& run, const Pattern& pattern, int q) {
  return is_count(pattern.of(q)) ||
         wrong(run, pattern, q, fmt::format("is no whole number from 1 to {}", kMaxPoints));
}

/// The angle from one point to the next: Q247, or the part of the circle that Q245 and Q246 leave.
bool polar_step(Run& run, const Pattern& pattern, double& step) {
  constexpr double kFull = 360;
  const double count = pattern.of(241);
  for (const int q : {245, 246, 247}) {
    if (!(std::fabs(pattern.of(q)) <= kFull)) return wrong(run, pattern, q, "is not -360 to 360");
  }
  step = pattern.of(247);
  if (step != 0 || count == 1) return true;
  const double whole = pattern.of(246) - pattern.of(245);
  if (whole == 0 || std::fabs(whole) > kFull) {
    return wrong(
        run, pattern, 246,
        fmt::format("with Q245 = {} and Q247 = 0 leaves no part of a circle", pattern.of(245)));
  }
  step = std::fabs(whole) == kFull ? whole / count : whole / (count - 1);
  return true;
}

bool polar_points(Run& run, const Pattern& pattern, std::vector<PlaneVector>& points) {
  double step = 0;
  if (!check_count(run, pattern, 241) || !polar_step(run, pattern, step)) return false;
  if (!(pattern.of(244) > 0)) return wrong(run, pattern, 244, "is no diameter");
  const PlaneVector center{pattern.mm(216), pattern.mm(217)};
  const double radius = pattern.mm(244) / 2;
  for (int i = 0; i < static_cast<int>(pattern.of(241)); ++i) {
    points.push_back(center + radius * unit_vector(pattern.of(245) + i * step));
  }
  return true;
}

/// Line by line, every second one backward.
bool cartesian_points(Run& run, const Pattern& pattern, std::vector<PlaneVector>& points) {
  if (!check_count(run, pattern, 242) || !check_count(run, pattern, 243)) return false;
  const double count = pattern.of(242) * pattern.of(243);
  if (count > kMaxPoints) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("Q242 by Q243 are {} points, at most {}", count, kMaxPoints));
  }
  const PlaneVector start{pattern.mm(225), pattern.mm(226)};
  const PlaneVector along = unit_vector(pattern.of(224));
  const PlaneVector across{-along.second, along.first};
  const int columns = static_cast<int>(pattern.of(242));
  for (int line = 0; line < static_cast<int>(pattern.of(243)); ++line) {
    for (int i = 0; i < columns; ++i) {
      const int column = line % 2 == 0 ? i : columns - 1 - i;
      points.push_back(start + (column * pattern.mm(237)) * along +
                       (line * pattern.mm(238)) * across);
    }
  }
  return true;
}

/// Set-up clearance, surface and second set-up clearance are the pattern's; the first rows of both.
constexpr std::array kShared{200, 203, 204};

void use_shared(Run& run, const Pattern& pattern) {
  const auto rows = cycle_table(run.state.cycle.machining.number);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::ranges::find(kShared, rows[i].q) != kShared.end())
      run.state.cycle_words[i] = pattern.of(rows[i].q);
  }
}

void over(Run& run, PlaneVector point) {
  const PlaneAxes axes = axes_of(run.state.plane);
  Target target = here(run.state);
  target.set(axes.first, point.first);
  target.set(axes.second, point.second);
  line_to(run, target, kRapid);
}

/// First to the second set-up clearance, then over the first point.
void make(Run& run, const std::vector<PlaneVector>& points, bool stays_low) {
  const int cycle = run.state.cycle.machining.number;
  const Table whole(run);
  const Table low(run, whole.clearance());
  whole.rapid(whole.last());
  for (std::size_t i = 0; i < points.size(); ++i) {
    over(run, points[i]);
    make_cycle(stays_low && i + 1 < points.size() ? low : whole, cycle);
  }
}

bool check_size(Run& run, const Table& table, std::size_t points) {
  const double passes = static_cast<double>(points) * passes_of(table);
  if (passes <= kMaxPatternPasses) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("{} points of cycle {} would be {:.0f} infeeds, at most {:.0f}",
                              points, run.state.cycle.machining.number, passes, kMaxPatternPasses));
}

/// With the pattern's words in those of the cycle.
bool make_pattern(Run& run, const Pattern& pattern, const std::vector<PlaneVector>& points) {
  State& state = run.state;
  const Table table(run);
  bool is_idle = false;
  if (!check_call(run, table, is_idle) || !check_size(run, table, points.size())) return false;
  if (is_idle) return true;
  const bool stays_low = pattern.of(301) == 0;
  if (!stays_within_limits(run, [&] { make(run, points, stays_low); })) return run.fail_at_limit();
  interrupt_contour(run);
  make(run, points, stays_low);
  state.last = LastMove{};
  state.polar.is_current = false;
  state.has_positioned = true;
  state.has_open_place = leaves_place_open(table, state.cycle.machining.number);
  return true;
}

}  // namespace

bool run_pattern(Run& run, int cycle, const std::vector<double>& words) {
  State& state = run.state;
  const int called = state.cycle.machining.number;
  const Pattern pattern(run, cycle, words);
  if (!is_at_a_point(called)) {
    return run.fail(
        ErrorCode::CycleIncomplete,
        fmt::format("CYCL DEF {} without a cycle before it that a pattern can call", cycle));
  }
  if (state.cycle.is_modal_call) {
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("CYCL DEF {} while M89 calls the cycle: end it with M99", cycle));
  }
  if (pattern.of(301) != 0 && pattern.of(301) != 1) {
    return wrong(run, pattern, 301, "is not 0 or 1");
  }
  std::vector<PlaneVector> points;
  const bool are_known = cycle == kPolarPattern ? polar_points(run, pattern, points)
                                                : cartesian_points(run, pattern, points);
  if (!are_known || !check_unchanged(run, kShared)) return false;
  const std::vector<double> defined = state.cycle_words;
  const auto rows = cycle_table(cycle);
  for (std::size_t i = 0; i < rows.size(); ++i) run.set_q(rows[i].q, words[i]);
  use_shared(run, pattern);
  state.has_open_place = false;
  const bool is_made = make_pattern(run, pattern, points);
  state.cycle_words = defined;  // a call after the pattern compares with its own definition
  return is_made;
}

}  // namespace dripline::interpreter::tnc155::itnc
