#pragma once

#include <optional>

#include "gateway/interpreter/stages/compensation/fault.hpp"
#include "gateway/interpreter/stages/compensation/impl/state.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"

namespace dripline::interpreter::compensation {

/// The last stage of a dialect before its sink: takes the programmed events, in machine
/// coordinates, and gives out the same events with the tool's path offset by the cutter radius.
///
/// While compensation is on, a move in the plane waits for the next one (`LookAheadStage`).
/// Inserted pieces carry the origin, rapid or feed of the element they lead to (with a feed of
/// inverse time all of them together take the programmed time). Axes outside the plane move on the
/// element itself.
class Compensator final : public look_ahead::LookAheadStage<Compensator, impl::State, FaultKind> {
 public:
  /// The sink must outlive it. `start` is where the machine is.
  Compensator(const Policy& policy, EventSink& sink, const Position& start = {});

  void on_compensation(const Command& command) override;
  using CompensationSink::cancel;
  /// As above, with the program at this point of the plane, and the tool left where it is.
  void cancel(PlaneVector programmed);
  /// As `cancel`, but the next move in the plane, a straight one, keeps the distance the tool has
  /// from the programmed point now, at its end as well.
  void cancel_in_parallel();
  /// The waiting start-up move meets the contour by an arc of this radius, which comes from a block
  /// of its own: tangent to the begin of the contour and to the straight move from the tool, on the
  /// tool's side. False when no start-up move waits.
  bool approach_by_arc(const Origin& origin, Length radius);
  /// As `turn_off`; the cancel move leaves the contour by such an arc.
  void turn_off_by_arc(const Origin& origin, Length radius);
  /// On, without a start-up move: the next move in the plane begins on its own normal, and the tool
  /// goes straight there from where it is. `programmed`: where that move comes from.
  void begin_contour(const Cutter& cutter);
  void begin_contour(const Cutter& cutter, PlaneVector programmed);
  /// As `cancel_in_parallel`, and where that move ends a contour begins.
  void turn_on_in_parallel(const Cutter& cutter);
  /// The waiting start-up move goes to its programmed end, and the next move in the plane is the
  /// start-up move.
  void start_again();
  /// The outside of the corner at the end of the waiting move is rounded in this manner.
  void shape_corner(OutsideCorner shape);
  /// The outside of the corner at the end of the next move in the plane is rounded in this manner.
  void shape_next_corner(OutsideCorner shape);
  /// Rounds the corner at the end of the last move as a move of its own: on the cutter's circle
  /// from that move's normal to the one of the next move in the plane, or at once to that of the
  /// direction `along`, of length 1. No effect without an offset. False: no compensated move came
  /// before.
  bool round_outside_corner(const Origin& origin, Feed feed, std::optional<PlaneVector> along = {});
  /// The sink from here on, also of a move that waits: flush before it.
  void lead_to(EventSink& sink);
  /// Ends the waiting move on its own normal. Compensation stays on.
  void flush();
  /// Off, no move waiting, no fault, the machine at `start`: no event is given out.
  void reset(const Position& start);

  /// On or starting; false once `turn_off` has been called.
  bool is_on() const;
  /// A contour is being followed with the nose's tip elsewhere than on `cutter`.
  bool changes_tip(const Cutter& cutter) const;

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_block_end(const Origin& event) override;
  void on_uncounted_block_end(const Origin& event) override;

 private:
  friend LookAheadStage;

  bool make_room(const Origin& origin);
  void keep_in_plane(Position& to) const;
  void follow(const Position& to);

  void start(const Cutter& cutter, StartUp start_up);
  void stop();
  void use(const Cutter& cutter);

  template <class Move>
  void on_linear(const Move& move, Feed feed, bool rests);
  void take(impl::Element& element);
  impl::Role next_role() const;
  bool accepts_arc(const impl::Element& arc);
  void decide_corner(impl::Element& next);
  std::optional<PlaneVector> last_direction() const;
  bool end_corner(const impl::Element& next);
  void begin_alone(impl::Element& element);
  void finish(PlaneVector end);
  void reach_begin(impl::Element& next);
  void end_compensation(const impl::Element& element);

  PlaneVector nose() const;
  void pass_over(const Position& to);
  bool is_off_plane() const;

  Policy policy_;
};

}  // namespace dripline::interpreter::compensation

namespace dripline::interpreter::look_ahead {
extern template class LookAheadStage<compensation::Compensator, compensation::impl::State,
                                     compensation::FaultKind>;
}
