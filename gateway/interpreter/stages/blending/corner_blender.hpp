#pragma once

#include <optional>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/stages/blending/fault.hpp"
#include "gateway/interpreter/stages/blending/impl/corner.hpp"
#include "gateway/interpreter/stages/blending/impl/state.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"
#include "gateway/interpreter/stages/compensation/compensator.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::blending {

/// More than any state takes.
inline constexpr std::size_t kMaxStateBytes = 64 * 1024;

/// The stage of a dialect that joins the moves of a contour, in front of compensation: roundings
/// and chamfers at corners, joins that the program only estimates, lines that are led back to the
/// move before them. Programmed events in machine coordinates go in, the same events with the true
/// ends of their moves come out, in the same order.
///
/// A move in the plane waits until the next one decides its end; all that comes between, block ends
/// included, waits with it and keeps its place. Where there is no room for more, or a stop of the
/// path comes (a rapid move, a thread, a probe, a prompt, the end), it ends as programmed. Moves
/// that no join changes come out exactly as they went in.
///
/// Bounded and without allocation, except for the bytes of a snapshot. Not thread-safe. After a
/// fault nothing more is given out until `reset`.
class CornerBlender final : public EventSink {
 public:
  /// The sink must outlive it. `start` is where the machine stands.
  CornerBlender(const Policy& policy, EventSink& sink, const Position& start = {});
  /// In front of compensation, which is then turned on and off through this stage.
  CornerBlender(const Policy& policy, compensation::Compensator& after, const Position& start = {});

  /// Of the elements. Another plane than the present one ends the wait.
  void set_plane(Plane plane);

  /// The next move, or the one that waits (a block of its own says so, whose place the inserted
  /// piece takes), ends in a corner with the one after it: an arc that touches both, or a straight
  /// piece between two lines. `feed` of the piece: none means that of the move (a chamfer of a
  /// rapid move is then rapid too). A size of 0 is no corner.
  void round_next_corner(Length radius, std::optional<Feed> feed = {});
  void chamfer_next_corner(Length size, Chamfer measure = Chamfer::Leg,
                           std::optional<Feed> feed = {});
  void round_corner(const Origin& origin, Length radius, std::optional<Feed> feed = {});
  void chamfer_corner(const Origin& origin, Length size, Chamfer measure = Chamfer::Leg,
                      std::optional<Feed> feed = {});

  /// The move that waits ends in no corner after all.
  void drop_corner();

  /// The ends of the next move are estimates, of an arc the center and this radius are not. Where
  /// two such moves follow one another, they join at the intersection nearest to the estimate; a
  /// line that misses its arc is turned about its other end until it touches. A point within
  /// `tolerance` of an arc is on it.
  void approximate_end(Length tolerance, Length radius = {});
  /// The next move, a line or a straight thread, has this slope (in the plane, from its first axis)
  /// and begins where it meets the move before it, which ends there.
  void back_solve_line(Angle slope, Back which);

  /// What stands after from here on; what waits goes there too.
  void lead_to(EventSink& sink);
  void lead_to(compensation::Compensator& after);
  /// What the compensator after is told, in its place among the events.
  void turn_on(const compensation::Cutter& cutter);
  void turn_on(const compensation::Cutter& cutter, compensation::StartUp start_up);
  void turn_off();
  void leave();
  void suppress_output(bool still);

  /// Ends what waits where the program says.
  void settle();
  /// Nothing waiting or announced, no fault, the machine at `start`: nothing is given out.
  void reset(const Position& start);
  /// The machine stands elsewhere than the events say (a reference point, a restart).
  void place(const Position& at);

  /// A move waits for the next one.
  bool is_waiting() const { return state_.has_element; }
  /// Set by the event that broke a rule.
  const std::optional<Fault>& fault() const { return fault_; }
  /// Where the moves given out so far lead.
  const Position& given() const { return state_.given; }

  /// The state at a block boundary, for a snapshot: equal bytes mean equal states. At most
  /// kMaxStateBytes. That of a compensator after is its own.
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
  /// `Compensator::end_uncounted_block`; an ordinary end where there is no compensator after.
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
  bool flows_on(const Line& event);
  template <class Move>
  void on_linear(const Move& move, Feed feed, bool rests);
  template <class Move>
  void off_plane_move(const Move& move);
  bool waits(const impl::Element& element) const;
  void take(impl::Element& element);
  void begin_alone(const impl::Element& element);
  void join(impl::Element& next);
  void lead_back(const Thread& thread);
  void finish(const impl::Corner* corner);
  void follow(const Position& to);
  void announce(impl::CornerShape::Kind kind, Length size, std::optional<Feed> feed);
  void shape_waiting(impl::CornerShape::Kind kind, const Origin& origin, Length size,
                     std::optional<Feed> feed);

  template <class Event>
  void hold_or_pass(const Event& event, const Origin& origin);
  template <class Event>
  void hold_or_pass(const Event& event) {
    hold_or_pass(event, event.origin);
  }
  void hold_or_pass(const impl::CompensationCall& call);
  void hold_or_pass(look_ahead::HeldText text, std::string_view content);
  bool make_room(const Origin& origin);
  void release_held(const impl::Corner* corner);
  template <class Event>
  void deliver(const Event& event, const impl::Corner* corner);
  template <class Event>
  void give(const Event& event);
  template <class Move>
  void deliver_aside(Move move);

  void refuse(FaultKind kind, const Origin& origin, const Origin& next);

  Policy policy_;
  EventSink* sink_;
  compensation::Compensator* compensator_ = nullptr;
  std::optional<Fault> fault_;
  impl::State state_;
};

}  // namespace dripline::interpreter::blending
