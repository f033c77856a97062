#pragma once

#include <span>

#include "gateway/interpreter/dialects/tnc155/itnc/cycle_table_run.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/pocket_shape.hpp"

/// What cycles that mill in the plane have in common.
namespace dripline::interpreter::tnc155::itnc {

/// The moves of a cycle in the plane, from where the tool is.
class Milling {
 public:
  explicit Milling(const Table& table);

  PlaneVector place() const;
  double height() const;
  /// That of the tool, in program coordinates: scaling makes it differ from the tool's own.
  double tool_radius() const { return tool_radius_; }
  /// Climb and up-cut milling of an inner wall with M3; a mirror image does not reverse it.
  Turn inner_turn() const { return inner_turn_; }

  void rapid(PlaneVector to) const;
  void line(PlaneVector to, double feed) const { line(to, height(), feed); }
  void line(PlaneVector to, double height, double feed) const;
  /// `height`: with another one than the tool has, a helix.
  void follow(const PathPiece& piece, double height, double feed) const;
  void follow(const PathPiece& piece, double feed) const { follow(piece, height(), feed); }
  void follow(std::span<const PathPiece> path, double feed) const;
  /// To another place in the plane at a height that is free.
  void over(PlaneVector to) const;
  const Table& table() const { return table_; }

 private:
  const Table& table_;
  PlaneAxes axes_;
  double tool_radius_ = 0;
  Turn inner_turn_ = Turn::Counterclockwise;
};

/// Of 0 to `last` in whole numbers; else an alarm.
bool check_choice(Run& run, const Table& table, int q, int last);
bool check_above_zero(Run& run, const Table& table, std::initializer_list<int> parameters);
/// Q351: -1, 0 or 1. A scaling of other than the plane's axes would make arcs that are none.
bool check_milling(Run& run, const Table& table);

bool check_thread(Run& run, const Table& table);
void mill_thread(const Table& table);

constexpr bool is_pocket(int cycle) {
  return cycle >= 251 && cycle <= 254;
}
bool check_pocket(Run& run, const Table& table, int cycle);
void mill_pocket(const Table& table, int cycle);
/// The control ends the cycle at a place that its manual does not state.
bool leaves_place_open(const Table& table, int cycle);
/// How many infeeds and passes around a call comes to, about.
double passes_of_pocket(const Table& table, int cycle);

}  // namespace dripline::interpreter::tnc155::itnc
