#pragma once

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

/// G12.1 and G07.1: a flat path that a rotary axis makes. The last stage before the sink: moves of
/// the plane come in, the moves of the rotary axis and its partner go out, in straight pieces.
namespace dripline::interpreter::fanuc {

/// Which flat path the machine's rotary axis makes.
struct RotaryPlane {
  enum class Kind : std::uint8_t {
    None,
    Polar,     ///< G12.1: the end face; the linear axis is the distance from the center
    Cylinder,  ///< G07.1: the surface rolled out; the rotary axis is a length on it
  };
  Kind kind = Kind::None;
  Axis rotary = Axis::C;
  Axis slot = Axis::Y;     ///< what the flat path has in place of the rotary axis
  Axis partner = Axis::X;  ///< of the polar plane: the linear axis
  double radius = 0;       ///< of the cylinder
  double zero_slot = 0;    ///< machine coordinates of the plane's zero
  double zero_partner = 0;
  double start_degrees = 0;  ///< of the rotary axis at that zero
  double held = 0;           ///< where the axis of the slot really is
  bool slot_has_moved = false;
  std::uint8_t plane_before = 17;  ///< in force again after the mode
};

class RotaryPath final : public EventFilter {
 public:
  /// `helix_feed_is_path`: F of a helix is the speed along it, not along its circle.
  RotaryPath(EventSink& out, bool helix_feed_is_path)
      : EventFilter(out), helix_feed_is_path_(helix_feed_is_path) {}

  void begin(const RotaryPlane& plane, const Position& at);
  void end();
  bool is_on() const { return state_.plane.kind != RotaryPlane::Kind::None; }
  /// Where the rotary axis is, degrees.
  double degrees() const { return state_.degrees; }
  /// A path too close to the center to follow.
  bool has_fault() const { return state_.has_fault; }

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;

  /// What a snapshot keeps.
  struct State {
    RotaryPlane plane;
    Position at;         ///< of the flat path
    double degrees = 0;  ///< of the rotary axis there
    bool has_fault = false;
  };
  const State& state() const { return state_; }
  void restore(const State& state) { state_ = state; }

 private:
  template <class PointAt>
  void deliver(const Line& whole, double length, int pieces, PointAt point_at);
  Position on_machine(const Position& flat);
  int pieces_of_line(const Position& to) const;

  const bool helix_feed_is_path_;
  State state_;
};

}  // namespace dripline::interpreter::fanuc
