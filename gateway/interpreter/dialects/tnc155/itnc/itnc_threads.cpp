#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/milling.hpp"

/// Cycle 262. Source: TNC 426/430 and iTNC 530, User's Manuals, Cycles: thread milling; its steps
/// are in this folder's README.
namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr double kFullTurn = 360, kHalfTurn = 180;
constexpr double kMaxThreadTurns = 2'000;
/// Q355: one turn, all revolutions at once; above that, revolutions that are so many pitches apart.
constexpr double kOneTurn = 0, kAllTurns = 1;

/// What the words come to; lengths in millimeters.
struct ThreadPlan {
  explicit ThreadPlan(const Table& table)
      : pitch(std::fabs(table.mm(239))), bottom(table.bottom()), surface(table.surface()) {
    const bool is_climb = table.of(351) >= 0;
    const double threads = table.of(355);
    goes_up = (table.of(239) > 0) == is_climb;
    revolutions = threads == kAllTurns ? (surface - bottom) / pitch : 1;
    step = threads > kAllTurns ? threads * pitch : 0;
    const double count = step > 0 ? std::min((surface - bottom) / step, 2 * kMaxThreadTurns) : 1;
    paths = static_cast<int>(std::ceil(count - 1e-9));
  }
  double sign() const { return goes_up ? 1 : -1; }
  /// Where the thread of a path begins.
  double begin(int path) const {
    return bottom + path * step + (goes_up ? 0 : revolutions * pitch);
  }

  double pitch;
  double bottom, surface;
  bool goes_up = true;     ///< a right-hand thread that is climb milled, and a left-hand one up-cut
  double revolutions = 1;  ///< of one path
  double step = 0;         ///< from path to path
  int paths = 1;
};

/// Half a circle to the thread, its revolutions, half a circle back; the height changes by the
/// pitch all the time.
void mill_path(const Milling& milling, const ThreadPlan& plan, int path) {
  const Table& table = milling.table();
  const PlaneVector center = milling.place();
  const double radius = table.mm(335) / 2 - milling.tool_radius();
  // A tool that is more than four pitches smaller goes to the side first.
  const double side = std::max(0.0, radius - 2 * plan.pitch);
  const Turn turn = milling.inner_turn();
  const double feed = table.feed(207), positioning = table.feed(253);
  const double half = plan.sign() * plan.pitch / 2;
  double height = plan.begin(path) - half;
  table.cut(height, positioning);
  milling.line(center + PlaneVector{side, 0}, positioning);
  const auto follow = [&](PlaneVector to, PlaneVector about, double sweep) {
    height += plan.sign() * plan.pitch * sweep / kFullTurn;
    milling.follow(arc_piece(to, about, turn, sweep), height, feed);
  };
  const double middle = (side + radius) / 2;
  follow(center + PlaneVector{radius, 0}, center + PlaneVector{middle, 0}, kHalfTurn);
  const double sweep = plan.revolutions * kFullTurn;
  const PlaneVector ray = unit_vector(sign_of_turn(turn) * sweep);
  follow(center + radius * ray, center, sweep);
  follow(center + side * ray, center + middle * ray, kHalfTurn);
  milling.line(center, positioning);
}

}  // namespace

bool check_thread(Run& run, const Table& table) {
  if (!check_milling(run, table) || !check_above_zero(run, table, {335, 207, 253})) return false;
  if (!check_choice(run, table, 355, 999)) return false;
  if (table.of(239) == 0) return run.fail(ErrorCode::EntryOutOfRange, "Q239 0 is no pitch");
  const Milling milling(table);
  if (table.mm(335) <= 2 * milling.tool_radius()) {
    return run.fail(
        ErrorCode::ToolRadiusTooLarge,
        fmt::format("thread {:.4f} mm, tool {:.4f} mm", table.mm(335), 2 * milling.tool_radius()));
  }
  const ThreadPlan plan(table);
  if (plan.revolutions * plan.paths > kMaxThreadTurns)
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("more than {} revolutions", kMaxThreadTurns));
  if (table.of(355) > kAllTurns && !plan.goes_up) {
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("Q355 {} from the top down: where its first turn begins is not "
                                "stated; Q351 {} goes up",
                                table.of(355), table.of(351) >= 0 ? -1 : 1));
  }
  return true;
}

void mill_thread(const Table& table) {
  const Milling milling(table);
  const ThreadPlan plan(table);
  table.rapid(table.clearance());
  for (int path = 0; path < plan.paths; ++path) mill_path(milling, plan, path);
  table.rapid(std::max(table.clearance(), milling.height()));
  table.rapid(table.last());
}

}  // namespace dripline::interpreter::tnc155::itnc
