#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gateway/app/restart/delivered_state.hpp"
#include "gateway/app/restart/passed_path.hpp"

namespace dripline::gateway {

/// One move of an approach; with a feed the last part of it.
struct ApproachMove {
  interpreter::Position to;                      ///< only the axes that move
  std::optional<Feed> feed;                      ///< absent: rapid
  std::optional<interpreter::PathArc> arc = {};  ///< with a feed
};

/// From where the axes are to where the program continues. The safe default for controls whose
/// manuals have none of their own: along the tool axis to the clearance, which is the highest place
/// where the program or the machine has been; the tool, if it is another one than that in the
/// spindle; the other axes; spindle and coolant; down again, rapidly to kPlunge above the place,
/// the rest at the feed of the program. Where the run does not show that this height is clear
/// (ClearHeights), nothing leads across: the axes go straight back where they are on the straight
/// move that the program continues with, as it made it; else the operator brings them to the place.
///
/// A lathe has no such place: in front of the part is beyond a wall for a tool in a groove. Its
/// tool goes back where it has been (lathe_approach.cpp), or the operator brings it to the place.
struct Approach {
  bool is_lathe = false;
  interpreter::Axis tool_axis = interpreter::Axis::Z;
  interpreter::Position from;  ///< the machine's
  interpreter::Position to;    ///< the program's; marks the axes that it has moved
  interpreter::Position highest;
  bool is_clear = false;     ///< to lead across at that height
  std::optional<Feed> feed;  ///< of the program, if it has had one
  bool spindle_turns = false;
  bool changes_tool = false;
  std::optional<interpreter::Axis> spindle_axis = {};  ///< of the tool that is in the spindle
  const PassedPath* passed = nullptr;                  ///< null: not known
  // Of a lathe.
  std::optional<interpreter::Position> stopped_at = {};  ///< where the run came to rest

  struct Plan {
    std::vector<ApproachMove> before;  ///< the spindle is switched on after these
    std::vector<ApproachMove> after;
    std::size_t retracts = 0;  ///< of `before`: with the tool that is in the spindle
    double clearance = 0;      ///< of the tool axis, millimeters
    std::string fault;         ///< why there is none, and what to do; empty: there is one
  };
  Plan plan() const;

  static constexpr double kPlunge = 2;                 ///< millimeters
  static constexpr double kPlungeFeedPerMinute = 100;  ///< where the program has had no feed

 private:
  Feed plunge_feed() const;
  bool differs(interpreter::Axis axis) const;
  bool is_far(interpreter::Axis axis) const;
  std::string height_fault() const;
  bool is_on_next_move() const;
  bool add_straight_back(Plan& plan) const;
  Plan lathe_plan() const;
  bool is_beyond_all() const;
  void add_retracts(Plan& plan) const;
  bool add_passed(Plan& plan) const;
  bool add_from_outside(Plan& plan) const;
  bool add_straight(Plan& plan) const;
  void add_route(Plan& plan, const std::vector<PassedMove>& route) const;
  bool leads_to_place(interpreter::PlaneVector place) const;
  std::string lathe_fault(bool are_others_elsewhere) const;
};

/// What a restart gives to the machine before the program's own events: the moves, after the first
/// ones of them the tool, spindle and coolant, and what the program had inhibited.
void write_approach(const Approach::Plan& plan, const DeliveredState& state,
                    const interpreter::Origin& origin, interpreter::EventSink& out);

}  // namespace dripline::gateway
