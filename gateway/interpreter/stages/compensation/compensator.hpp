#pragma once

#include <optional>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/stages/compensation/fault.hpp"
#include "gateway/interpreter/stages/compensation/impl/state.hpp"
#include "gateway/interpreter/stages/compensation/policy.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::compensation {

/// More than any state takes.
inline constexpr std::size_t kMaxStateBytes = 64 * 1024;

/// The last stage of a dialect before its sink: takes the programmed events, in machine
/// coordinates, and gives out the same events with the tool's path offset by the cutter radius.
///
/// While compensation is on, a move in the plane waits until the next one decides its end; all that
/// comes between, block ends included, waits with it and keeps its place. Inserted pieces carry the
/// origin, rapid or feed of the element they lead to (with a feed of inverse time all of them
/// together take the programmed time). Axes outside the plane move on the element itself.
///
/// Bounded and without allocation, except for the bytes of a snapshot. Not thread-safe. After a
/// fault nothing more is given out until `reset`.
class Compensator final : public EventSink {
 public:
  /// The sink must outlive it. `start` is where the machine stands.
  Compensator(const Policy& policy, EventSink& sink, const Position& start = {});

  /// The next move in the plane is the start-up move. While on: the elements from here on are
  /// offset by the new cutter; another plane is left and started anew. On the same side a corner
  /// between two radii is a corner as any other; between two sides the first element ends and the
  /// second begins on its own normal, joined by a straight piece.
  void turn_on(const Cutter& cutter);
  /// As above, with another start-up than the policy's for this one time.
  void turn_on(const Cutter& cutter, StartUp start_up);
  /// The next move in the plane is the cancel move; until then the tool keeps its place in the
  /// plane.
  void turn_off();
  /// Ends what waits on its own normal and is off: the next move in the plane goes straight from
  /// where the tool is to its programmed end, whatever it is. What interrupts compensation does
  /// this, then `turn_on` again.
  void leave();
  /// As above, with the program at this point of the plane, and the tool left where it is.
  void leave(PlaneVector programmed);
  /// As `leave`, but the next move in the plane, a straight one, keeps the distance the tool has
  /// from the programmed point now, at its end as well.
  void leave_in_parallel();
  /// The start-up move that waits meets the contour by an arc of this radius, which comes from a
  /// block of its own: tangent to the contour's begin, straight to where it is tangent to the way
  /// from the tool, on the tool's side. False when no start-up move waits.
  bool approach_by_arc(const Origin& origin, Length radius);
  /// As `turn_off`; the cancel move leaves the contour by such an arc.
  void turn_off_by_arc(const Origin& origin, Length radius);
  /// On, without a start-up move: the next move in the plane begins on its own normal, and the tool
  /// goes straight there from where it is. `programmed`: where that move comes from.
  void begin_contour(const Cutter& cutter);
  void begin_contour(const Cutter& cutter, PlaneVector programmed);
  /// As `leave_in_parallel`, and where that move ends a contour begins.
  void turn_on_in_parallel(const Cutter& cutter);
  /// The start-up move that waits goes to its programmed end, and the next move in the plane is the
  /// start-up move.
  void start_again();
  /// Goes round the outside of the corner at the end of the move that waits in this manner.
  void shape_corner(OutsideCorner shape);
  /// Round the outside of the corner at the end of the next move in the plane in this manner.
  void shape_next_corner(OutsideCorner shape);
  /// Goes round the corner that the last move has come to as a move of its own: on the cutter's
  /// circle from that move's normal to the one of the next move in the plane, or at once to that of
  /// the direction `along`, of length 1. Nothing where nothing is offset. False: no compensated
  /// move came before.
  bool round_outside_corner(const Origin& origin, Feed feed, std::optional<PlaneVector> along = {});
  /// From here on (`still`), or no longer: moves lead the program on and decide corners, but the
  /// tool does not carry them out. The next real move goes from where the tool stands.
  void suppress_output(bool still) { state_.is_output_suppressed = still; }
  /// Ends what waits on its own normal. Compensation stays on.
  void settle();
  /// Off, nothing waiting, no fault, the machine at `start`: nothing is given out.
  void reset(const Position& start);
  /// The machine stands elsewhere than the events say (a reference point, a restart).
  void place(const Position& at);

  /// On or starting; false once `turn_off` has been called.
  bool is_on() const;
  /// The next move in the plane is the start-up move.
  bool is_starting() const { return state_.phase == impl::Phase::Starting; }
  /// The move that waits is the start-up move.
  bool is_start_waiting() const {
    return state_.has_element && state_.waiting().role == impl::Role::StartUp;
  }
  /// A move waits for the next one.
  bool is_waiting() const { return state_.has_element; }
  /// Set by the event that broke a rule.
  const std::optional<Fault>& fault() const { return fault_; }
  /// Where the tool has been sent so far.
  const Position& tool() const { return state_.tool; }

  /// The state at a block boundary, for a snapshot: equal bytes mean equal states. At most
  /// kMaxStateBytes.
  std::vector<std::byte> state() const;
  /// Errors: Corrupt; the state is then unchanged.
  Result<void> restore(const std::vector<std::byte>& state);

  void on_program(const ProgramHeader& event) override;
  void on_units(const UnitsChange& event) override;
  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_dwell(const Dwell& event) override;
  void on_spindle(const Spindle& event) override;
  void on_coolant(const Coolant& event) override;
  void on_tool(const ToolChange& event) override;
  void on_miscellaneous(const Miscellaneous& event) override;
  void on_pin(const PinChange& event) override;
  void on_output(const Output& event) override;
  void on_open(const Open& event) override;
  void on_close(const Close& event) override;
  void on_message(const Message& event) override;
  void on_stop(const Stop& event) override;
  void on_override_inhibit(const OverrideInhibit& event) override;
  void on_block_end(const Origin& event) override;
  /// As on_block_end, of a block that `Policy::blocks_without_motion` does not count: it says
  /// nothing to the machine (a macro statement, a call, a return).
  void end_uncounted_block(const Origin& event);
  /// These need the tool in its place: what waits is settled first.
  void on_thread(const Thread& event) override;
  void on_probe(const Probe& event) override;
  void on_prompt(const Prompt& event) override;
  void on_alarm(const Alarm& event) override;
  void on_end(const End& event) override;
  /// About the text, not the motion: delivered at once.
  void on_blank(const Blank& event) override;
  void on_warning(const Warning& event) override;

 private:
  using HeldEvent = look_ahead::HeldEvents<>::Event;

  template <class Move>
  void on_linear(const Move& move, Feed feed, bool rests);
  template <class Move>
  void off_plane_move(const Move& move);
  void take(impl::Element& element);
  impl::Role next_role() const;
  void use(const Cutter& cutter);
  bool accepts_arc(const impl::Element& arc);
  void join(impl::Element& next);
  std::optional<PlaneVector> last_direction() const;
  bool end_corner(const impl::Element& next);
  void begin_alone(impl::Element& element);
  void finish(PlaneVector end);
  void reach_begin(impl::Element& next);
  void end_compensation(const impl::Element& element);

  template <class Event>
  void hold_or_pass(const Event& event);
  void hold_or_pass(look_ahead::HeldText text, std::string_view content);
  template <class Event>
  void hold(const Event& event, const Origin& origin);
  void release_held();
  void deliver(const HeldEvent& event);
  template <class Move>
  void deliver_aside(Move move);

  PlaneVector nose() const;
  void follow(const Position& to);
  void pass_over(const Position& to);
  bool is_off_plane() const;
  /// Always false.
  bool refuse(const Fault& fault);

  Policy policy_;
  EventSink& sink_;
  std::optional<Fault> fault_;
  impl::State state_;
};

}  // namespace dripline::interpreter::compensation
