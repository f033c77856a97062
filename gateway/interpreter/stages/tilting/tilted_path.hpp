#pragma once

#include <optional>
#include <string>

#include "gateway/interpreter/stages/event_filter.hpp"
#include "gateway/interpreter/stages/tilting/kinematics.hpp"

/// Tilted working planes and tool center point control: the last stage before the sink. Moves of
/// the tip as the program has it come in, moves of the machine's axes go out. Without them it only
/// checks the travel of a path that cutter compensation has made.
namespace dripline::interpreter::tilting {

/// What the control decides. It must outlive the stage.
class TiltRules {
 public:
  TiltRules() = default;
  TiltRules(const TiltRules&) = delete;
  TiltRules& operator=(const TiltRules&) = delete;
  virtual ~TiltRules() = default;

  virtual const Kinematics& kinematics() const = 0;
  /// The feeds of moves that come in are those of the linear axes' path, a helix without its
  /// height: here they become what the machine's axes need. False: they are that already.
  virtual bool sets_axis_feeds() const { return false; }
  virtual bool helix_feed_is_path() const { return true; }
  /// Whether `travel_fault` may find something.
  virtual bool checks_travel() const { return false; }
  /// What forbids the straight path of the machine's axes; empty: nothing.
  virtual std::string travel_fault(const Position& /*from*/, const Position& /*to*/,
                                   Units /*units*/) const {
    return {};
  }
};

/// Where the programmed points are on the machine.
struct Tilt {
  enum class Kind : std::uint8_t {
    None,
    Plane,      ///< coordinates of a plane of the workpiece; the rotary axes rest
    TipControl  ///< coordinates of the workpiece, where the tip moves straight
  };
  Kind kind = Kind::None;
  Matrix3 frame{};         ///< the axes of the program, in machine coordinates at `zero`
  Point3 at{};             ///< the program's zero there,
  Point3 flat_zero{};      ///< and in the coordinates of the moves that come in
  Pose zero{};             ///< of the rotary axes that the work offset is right for
  double length = 0;       ///< of the tool, as compensated
  double mm_per_unit = 1;  ///< of F for a move in which the tip rests, degrees per unit
};

class TiltedPath final : public EventFilter {
 public:
  TiltedPath(EventSink& out, const TiltRules& rules) : EventFilter(out), rules_(rules) {}

  /// `machine` is where the axes are.
  void begin(const Tilt& tilt, const Position& machine);
  void end() { state_.tilt.kind = Tilt::Kind::None; }
  /// Without these modes: where the moves that come in continue from.
  void place(const Position& machine, double mm_per_unit);
  Tilt::Kind kind() const { return state_.tilt.kind; }
  bool is_on() const { return kind() != Tilt::Kind::None; }

  /// Where the program's moves have led, in their own coordinates, and the machine's axes.
  const Position& flat() const { return state_.flat; }
  const Position& machine() const { return state_.machine; }
  /// The rotary axes for a tool along `direction`, of length 1 in the program's coordinates;
  /// nullopt: there are none.
  std::optional<Pose> pose_for(const Point3& direction) const;
  /// The rotary axes alone move: a line with `feed`, else a rapid move.
  void turn_to(const Origin& origin, Pose pose, const std::optional<Feed>& feed, bool rests);
  void set_length(double length) { state_.tilt.length = length; }
  double length_in_force() const { return state_.tilt.length; }
  /// Whether a length has come into force since the last move that takes the axes elsewhere.
  bool lags() const;
  /// The axes go to where the tool's length has the tip where it is in the program.
  void take_length(const Origin& origin, const std::optional<Feed>& feed, bool rests);
  /// Of machine coordinates, with the rotary axes as they are.
  Position flat_of(const Position& machine) const;

  /// A move that was not made: nothing of it has gone out.
  struct Fault {
    bool is_travel = false;  ///< beyond the axes' travel; else the path takes too many pieces
    Origin origin;
    std::string text;
  };
  const std::optional<Fault>& fault() const { return fault_; }

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& programmed) override;
  void on_thread(const Thread& event) override;
  void on_probe(const Probe& event) override;
  void on_units(const UnitsChange& event) override;
  void on_end(const End& event) override;

  /// What a snapshot keeps.
  struct State {
    Tilt tilt;
    Position flat;
    Position machine;
  };
  const State& state() const { return state_; }
  void restore(const State& state) {
    state_ = state;
    fault_.reset();
  }

 private:
  Position on_machine(const Position& flat) const;
  Matrix3 turn_now() const;
  int pieces_of(const Position& to) const;
  double minutes_of(const Line& line) const;
  Feed feed_within(double revolutions, const Position& to) const;
  Feed feed_of_axes(const Feed& feed, const Position& to) const;
  bool check(const Origin& origin, const Position& from, const Position& to);
  bool check_pieces(const Origin& origin, const Position& to, int pieces);
  bool check_arc(const Arc& arc);
  template <class Event>
  void deliver_checked(const Event& event, void (EventSink::*deliver)(const Event&));
  bool arc_on_machine(const Arc& flat, Arc& arc) const;
  template <class Event>
  void deliver_straight(const Event& whole, void (EventSink::*deliver)(const Event&));
  void deliver_pieces_of_arc(const Arc& arc);

  const TiltRules& rules_;
  State state_;
  std::optional<Fault> fault_;
};

}  // namespace dripline::interpreter::tilting
