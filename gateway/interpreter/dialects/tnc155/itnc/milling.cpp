#include "gateway/interpreter/dialects/tnc155/itnc/milling.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"

namespace dripline::interpreter::tnc155::itnc {

Milling::Milling(const Table& table) : table_(table), axes_(axes_of(table.run().state.plane)) {
  const State& state = table.run().state;
  tool_radius_ = state.tool.data.radius / state.transformation.factor(state.plane);
  const bool is_climb = table.of(351) >= 0;
  const bool is_mirrored = state.transformation.turns_over(state.plane);
  inner_turn_ = is_climb != is_mirrored ? Turn::Counterclockwise : Turn::Clockwise;
}

PlaneVector Milling::place() const {
  return in_plane(table_.run().state, here(table_.run().state));
}

double Milling::height() const {
  const State& state = table_.run().state;
  return here(state).at[index(state.tool.axis)];
}

void Milling::rapid(PlaneVector to) const {
  Run& run = table_.run();
  Target target = here(run.state);
  target.set(axes_.first, to.first);
  target.set(axes_.second, to.second);
  line_to(run, target, kRapid);
}

void Milling::line(PlaneVector to, double height, double feed) const {
  Run& run = table_.run();
  Target target = here(run.state);
  target.set(axes_.first, to.first);
  target.set(axes_.second, to.second);
  target.set(run.state.tool.axis, height);
  line_to(run, target, {false, feed, feed});
}

void Milling::follow(const PathPiece& piece, double height, double feed) const {
  if (!piece.is_arc) return line(piece.to, height, feed);
  constexpr double kNoAngle = 1e-9, kNoRadius = 1e-6;
  const PlaneVector out = piece.to - piece.center;
  if (piece.sweep < kNoAngle || std::hypot(out.first, out.second) < kNoRadius)
    return line(piece.to, height, feed);
  Run& run = table_.run();
  ArcTarget target;
  target.to = here(run.state);
  target.to.set(axes_.first, piece.to.first);
  target.to.set(axes_.second, piece.to.second);
  target.to.set(run.state.tool.axis, height);
  target.center = piece.center;
  target.turn = piece.turn;
  target.sweep = piece.sweep;
  arc_to(run, target, {false, feed, feed});
}

void Milling::follow(std::span<const PathPiece> path, double feed) const {
  for (const PathPiece& piece : path) follow(piece, feed);
}

void Milling::over(PlaneVector to) const {
  if (to == place()) return;
  table_.rapid(std::max(height(), table_.last()));
  rapid(to);
}

bool check_choice(Run& run, const Table& table, int q, int last) {
  const double value = table.of(q);
  if (value >= 0 && value <= last && value == std::trunc(value)) return true;
  return run.fail(ErrorCode::EntryOutOfRange, fmt::format("Q{} {} is not 0 to {}", q, value, last));
}

bool check_above_zero(Run& run, const Table& table, std::initializer_list<int> parameters) {
  for (const int q : parameters) {
    if (table.of(q) > 0) continue;
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("Q{} {} is not above 0", q, table.of(q)));
  }
  return true;
}

bool check_milling(Run& run, const Table& table) {
  if (!check_circle_plane(run)) return false;
  const double direction = table.of(351);
  if (direction != 0 && std::fabs(direction) != 1)
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("Q351 {} is not -1, 0 or 1", direction));
  return run.state.tool.data.radius > 0 ||
         run.fail(ErrorCode::ToolRadiusTooLarge, "a tool without a radius mills nothing");
}

bool check_place_is_known(Run& run) {
  return !run.state.has_open_place ||
         run.fail(ErrorCode::NotSupported,
                  "where CYCL DEF 253 with Q367 other than 0 ends is not stated: L with both axes "
                  "of the plane, absolute, before this");
}

/// The next move in the plane names both of its axes.
bool leave_open_place(Run& run, const Block& block) {
  State& state = run.state;
  if (!state.has_open_place) return true;
  const PlaneAxes axes = axes_of(state.plane);
  const auto is_in_plane = [&](const Coordinate& word) {
    return word.axis == axes.first || word.axis == axes.second;
  };
  const auto names = block.words();
  const bool is_straight = block.kind == BlockKind::Line;
  if (is_straight && std::ranges::none_of(names, is_in_plane)) return true;
  const bool is_stated = is_straight && block.names(axes.first) && block.names(axes.second) &&
                         std::ranges::none_of(names, [&](const Coordinate& word) {
                           return is_in_plane(word) && word.is_incremental;
                         });
  if (!is_stated) return check_place_is_known(run);
  state.has_open_place = false;
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
