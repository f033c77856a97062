#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/itnc/pocket_figure.hpp"

/// What cycles 251 to 254 refuse before they move.
namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr double kMaxPocketPasses = 4'000;
constexpr int kMaxRepeats = 1'000;

bool fail_word(Run& run, const Table& table, int q, std::string_view what) {
  return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q{} {} {}", q, table.of(q), what));
}

bool check_figure(Run& run, const Table& table, int cycle) {
  switch (cycle) {
    case kRectangularPocket:
      if (!check_above_zero(run, table, {218, 219}) || !check_choice(run, table, 367, 4))
        return false;
      return table.mm(220) <= std::min(table.mm(218), table.mm(219)) / 2 + kSameLength ||
             fail_word(run, table, 220, "is more than half a side");
    case kCircularPocket:
      return check_above_zero(run, table, {223});
    case kSlot:
      if (!check_above_zero(run, table, {218, 219}) || !check_choice(run, table, 367, 4))
        return false;
      return table.mm(218) >= table.mm(219) ||
             fail_word(run, table, 218, "is less than the width Q219");
    default:
      if (!check_above_zero(run, table, {219, 375})) return false;
      if (!(table.of(248) > 0 && table.of(248) <= 360))
        return fail_word(run, table, 248, "is not above 0, up to 360");
      if (table.of(377) < 1 || !check_choice(run, table, 377, kMaxRepeats))
        return table.of(377) >= 1 ? false : fail_word(run, table, 377, "is no number of slots");
      return table.mm(375) > table.mm(219) ||
             fail_word(run, table, 375, "has the inner side of the slot beyond its center");
  }
}

bool check_infeeds(Run& run, const Table& table, int cycle) {
  const bool roughs = whole_word(table, 215) != kFinishing;
  if (!check_above_zero(run, table, {206, 207}) || (roughs && !check_above_zero(run, table, {202})))
    return false;
  if (table.mm(369) >= -table.mm(201))
    return fail_word(run, table, 369, "is no less than the depth");
  constexpr double kLeastOverlap = 0.1, kMostOverlap = 2;
  if (!is_slot(cycle) && !(table.of(370) >= kLeastOverlap && table.of(370) < kMostOverlap))
    return fail_word(run, table, 370, "is not 0.1 to 1.9999");
  if (passes_of_pocket(table, cycle) <= kMaxPocketPasses) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("CYCL DEF {} would be {:.0f} passes, at most {:.0f}", cycle,
                              passes_of_pocket(table, cycle), kMaxPocketPasses));
}

/// The control's table of tools has the angle; with 0 it refuses to plunge along a slope.
bool check_plunging(Run& run, const Table& table, int cycle, const PocketShape& shape) {
  const Milling milling(table);
  const int plunge = whole_word(table, 366);
  if (plunge == 0 || whole_word(table, 215) == kFinishing) return true;
  if (!(run.options.plunge_angle > 0))
    return run.fail(
        ErrorCode::NotSupported,
        fmt::format("Q366 {} needs the tool's angle of plunging (option plunge_angle)", plunge));
  const double room = shape.room - table.mm(368), tool = milling.tool_radius();
  if (plunge == kHelical && helix_radius(room, tool) > 0) return true;
  if (cycle != kCircularPocket &&
      ramp_length(shape, std::max(0.0, room), tool) > kLeastHelix * tool)
    return true;
  return fail_word(run, table, 366, "has no room to plunge along a slope");
}

}  // namespace

double passes_of_pocket(const Table& table, int cycle) {
  const Milling milling(table);
  const double tool = milling.tool_radius();
  const PocketShape shape = shape_of(table, cycle, {}, tool);
  const double lines = 1 + std::max(0, lines_to(shape.room, stepover(table, cycle, tool)));
  const double depth = -table.mm(201);
  const double levels = std::ceil(depth / table.mm(202) - kSliverOfStep);
  const double infeeds = table.mm(338) > 0 ? std::ceil(depth / table.mm(338) - kSliverOfStep) : 1;
  double ramps = 0;
  if (whole_word(table, 366) != 0 && table.run().options.plunge_angle > 0) {
    const double slope = std::tan(table.run().options.plunge_angle * (Angle::kPi / 180));
    const double helix = helix_radius(shape.room - table.mm(368), tool);
    const bool is_helix = whole_word(table, 366) == kHelical && helix > 0;
    const double length = is_helix ? 2 * Angle::kPi * helix
                                   : std::max(kLeastHelix * tool, ramp_length(shape, 0, tool));
    ramps = depth / slope / length;
  }
  const double repeats = cycle == kRoundSlot ? table.of(377) : 1;
  return repeats * (levels * lines + ramps + infeeds + lines);
}

bool check_pocket(Run& run, const Table& table, int cycle) {
  if (!check_milling(run, table)) return false;
  if (!check_choice(run, table, 215, 2) ||
      !check_choice(run, table, 366, cycle == kCircularPocket ? 1 : 2))
    return false;
  if (!check_figure(run, table, cycle) || !check_infeeds(run, table, cycle)) return false;
  const Milling milling(table);
  const PocketShape shape = shape_of(table, cycle, {}, milling.tool_radius());
  const bool roughs = whole_word(table, 215) != kFinishing;
  if (shape.room - (roughs ? table.mm(368) : 0) < -kSameLength) {
    return run.fail(ErrorCode::ToolRadiusTooLarge,
                    fmt::format("tool of radius {:.4f} mm{} in a width of {:.4f} mm",
                                milling.tool_radius(), roughs ? " and the allowance Q368" : "",
                                2 * (shape.room + milling.tool_radius())));
  }
  if (!roughs && !has_allowance(table))
    run.warn("TNC-ACCEPTED", "finishing alone without an allowance (Q368, Q369) does nothing");
  return check_plunging(run, table, cycle, shape);
}

bool leaves_place_open(const Table& table, int cycle) {
  return cycle == kSlot && whole_word(table, 367) != 0;
}

}  // namespace dripline::interpreter::tnc155::itnc
