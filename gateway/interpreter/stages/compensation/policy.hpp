#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/core/event.hpp"

/// Cutter and tool nose radius compensation in a plane: the rules of a control as data. A dialect
/// fills a Policy; it never changes how another control's rules are carried out.

namespace dripline::interpreter::compensation {

/// The side of the path, looking along it, with the plane's third axis pointing at the viewer.
enum class Side : std::uint8_t { Left, Right };

/// How the tool goes round the outside of a corner. Where a rapid move follows, `Arc` means
/// `ExtendTangents` unless `Policy::rounds_at_rapid`.
enum class OutsideCorner : std::uint8_t {
  ExtendTangents,   ///< both offset elements continue along their tangents: to their intersection,
                    ///< or beyond `Policy::sharpest` each by one radius, with a straight piece
                    ///< between
  Arc,              ///< an arc of the cutter radius about the corner
  IntersectCurves,  ///< the offset lines and circles themselves, prolonged to where they meet
};

enum class InsideCorner : std::uint8_t {
  Intersect,  ///< the intersection of the offset elements that is nearest to the corner
  Refuse,     ///< FaultKind::ConcaveCorner: the programmer rounds inside corners
};

/// Where the start-up move ends. `P` is its programmed end, `n` the offset to the compensated side.
enum class StartUp : std::uint8_t {
  NextNormal,  ///< on the normal of the next element at P
  Corner,      ///< outside corners as any other corner, with the start-up move as an element;
               ///< inside ones as NextNormal
  Tangent,     ///< where its straight line touches the cutter's circle about P, then round P on it
};

/// Where the last compensated element ends, from which the cancel move goes to its programmed end.
enum class Cancel : std::uint8_t {
  OwnNormal,  ///< on its own normal
  Corner,     ///< outside corners as any other corner, with the cancel move as an element; inside
              ///< ones as OwnNormal
};

/// How a straight element begins when the element before it was ended on its own normal because
/// nothing was known of this one. An arc is always reached by a straight piece.
enum class Resume : std::uint8_t {
  Straight,  ///< straight from where the tool is to its own compensated end
  OwnNormal  ///< a straight piece to its own normal first
};

/// A corner between two cutters: a new radius, or the other side.
enum class CutterChange : std::uint8_t {
  OwnNormals,  ///< a radius: each element on its own offset, a corner as any other; a side: on its
               ///< own normal each, connected by a straight piece
  AtNextEnd    ///< a radius: the corner is that of the old one, the next element ends with the new
               ///< one, and has to be straight; a side: where both offset elements meet, if they do
};

struct Policy {
  OutsideCorner outside = OutsideCorner::ExtendTangents;
  /// The largest change of direction that ExtendTangents rounds with one point; above it, two.
  Angle sharpest = Angle::degrees(90);
  InsideCorner inside = InsideCorner::Intersect;
  StartUp start_up = StartUp::NextNormal;
  Cancel cancel = Cancel::OwnNormal;
  Resume resume = Resume::Straight;
  CutterChange cutter_change = CutterChange::OwnNormals;
  /// Directions that differ by no more than this go straight on.
  Angle tangent_tolerance = Angle::radians(1e-9);
  /// So many blocks in a row without motion in the plane are looked across; one more ends the
  /// element before them on its own normal.
  int blocks_without_motion = 1;
  /// A rapid move is a fast feed move: it gets the corner arcs of any other.
  bool rounds_at_rapid = false;
  /// The feed of an arc that leads to or from a contour, or round a corner, whose element is a
  /// rapid move.
  Feed arc_at_rapid;
};

/// The offset of the path: its amount and side. A negative radius swaps the side. `tip_first` and
/// `tip_second` lead from the center of a lathe tool's nose to the point that events position.
struct Cutter {
  Plane plane = Plane::XY;
  Side side = Side::Left;
  Length radius;
  Length tip_first, tip_second;
};

/// A command to compensation as data, which a stage in front of it keeps in its place among the
/// events.
struct Command {
  enum class Kind : std::uint8_t {
    TurnOn,          ///< from the next move on, with `cutter`
    TurnOff,         ///< the next move is the cancel move
    Cancel,          ///< off at once; the next move goes straight to its programmed end
    SuppressOutput,  ///< moves lead the program, the tool does not carry them out
    ResumeOutput,
  };
  Kind kind = Kind::TurnOff;
  Cutter cutter{};
  std::optional<StartUp> start_up{};  ///< of TurnOn, in place of the policy's
};

/// A sink that takes commands to compensation: the compensator, and a stage in front of it.
class CompensationSink : public EventSink {
 public:
  virtual void on_compensation(const Command& command) = 0;
  /// As on_block_end, of a block that `Policy::blocks_without_motion` leaves out: it has nothing
  /// for the machine (a macro statement, a call, a return).
  virtual void on_uncounted_block_end(const Origin& event) = 0;

  /// The next move in the plane is the start-up move. While on: the elements from here on are
  /// offset by the new cutter; for another plane compensation is canceled and started again. The
  /// corner between two cutters is as `Policy::cutter_change` has it. `start_up` replaces the
  /// policy's for this one time.
  void turn_on(const Cutter& cutter, std::optional<StartUp> start_up = {}) {
    on_compensation({Command::Kind::TurnOn, cutter, start_up});
  }
  /// The next move in the plane is the cancel move; until then the tool keeps its place in the
  /// plane.
  void turn_off() { on_compensation({Command::Kind::TurnOff}); }
  /// Ends the waiting move on its own normal and is off: the next move in the plane goes straight
  /// from where the tool is to its programmed end, whatever it is. What interrupts compensation
  /// cancels it, then switches it on again.
  void cancel() { on_compensation({Command::Kind::Cancel}); }
  /// From here on, or no longer: moves lead the program and decide corners, but the tool does not
  /// carry them out. The next real move starts from where the tool is.
  void suppress_output(bool is_suppressed) {
    on_compensation({is_suppressed ? Command::Kind::SuppressOutput : Command::Kind::ResumeOutput});
  }
};

}  // namespace dripline::interpreter::compensation
