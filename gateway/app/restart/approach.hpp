#pragma once

#include <optional>
#include <vector>

#include "gateway/app/restart/delivered_state.hpp"

namespace dripline::gateway {

/// One move of an approach; with a feed the last part of it.
struct ApproachMove {
  interpreter::Position to;  ///< only the axes that move
  std::optional<Feed> feed;  ///< absent: rapid
};

/// From where the axes are to where the program continues. The safe default for controls whose
/// manuals have none of their own: along the tool axis to the clearance, which is the highest place
/// where the program or the machine has been; the other axes; spindle and coolant; down again,
/// rapidly to kPlunge above the place, the rest at the feed of the program.
///
/// A lathe's Z is its tool axis here, as it is for the Centurion's own search (manual: RUN and
/// VERIFY): it retracts in front of the part, and its path back is a feed from the clearance on. A
/// tool that has only moved along X, or only along Z, goes straight back: at the floor of a groove,
/// the path in front of the part is through its wall.
struct Approach {
  bool is_lathe = false;
  interpreter::Axis tool_axis = interpreter::Axis::Z;
  interpreter::Position from;  ///< the machine's
  interpreter::Position to;    ///< the program's; marks the axes that it has moved
  interpreter::Position highest;
  std::optional<Feed> feed;  ///< of the program, if it has had one
  bool spindle_turns = false;

  struct Plan {
    std::vector<ApproachMove> before;  ///< the spindle is switched on after these
    std::vector<ApproachMove> after;
    double clearance = 0;  ///< of the tool axis, millimeters
  };
  Plan plan() const;

  static constexpr double kPlunge = 2;                 ///< millimeters
  static constexpr double kPlungeFeedPerMinute = 100;  ///< where the program has had no feed

 private:
  Feed plunge_feed() const;
  bool differs(interpreter::Axis axis) const;
  /// Where it is one alone.
  std::optional<interpreter::Axis> axis_elsewhere() const;
};

/// What a restart gives to the machine before the program's own events: tool, the moves, spindle
/// and coolant, and what the program had inhibited.
void write_approach(const Approach::Plan& plan, const DeliveredState& state,
                    const interpreter::Origin& origin, interpreter::EventSink& out);

}  // namespace dripline::gateway
