#pragma once

#include <optional>

#include "gateway/interpreter/stages/blending/impl/corner.hpp"
#include "gateway/interpreter/stages/blending/impl/state.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"

namespace dripline::interpreter::blending {

/// The stage of a dialect that blends the moves of a contour, in front of compensation: roundings
/// and chamfers at corners, ends that the program only approximates, lines that are solved back to
/// the move before them. Programmed events in machine coordinates go in, the same events with the
/// true ends of their moves come out, in the same order.
///
/// A move in the plane waits for the next one (`LookAheadStage`). Where there is no room for more,
/// or the path stops (a rapid move, a thread, a probe, a prompt, the end), it ends as programmed.
/// Moves that no blend changes come out exactly as they went in.
class CornerBlender final
    : public look_ahead::LookAheadStage<CornerBlender, impl::State, FaultKind> {
 public:
  /// The sink must outlive it. `start` is where the machine is.
  CornerBlender(const Policy& policy, EventSink& sink, const Position& start = {});
  /// In front of compensation, which then takes its commands through this stage.
  CornerBlender(const Policy& policy, CompensationSink& sink, const Position& start = {});

  /// The plane of the elements. Another plane than the present one ends the wait.
  void set_plane(Plane plane);

  /// The next move, or the waiting one (by a block of its own, whose place the inserted piece
  /// takes), ends in a corner with the one after it: an arc that touches both, or a straight
  /// piece between two lines. `feed` of the piece: none means that of the move (a chamfer of a
  /// rapid move is then rapid too). A size of 0 is no corner.
  void round_next_corner(Length radius, std::optional<Feed> feed = {});
  void chamfer_next_corner(Length size, Chamfer measure = Chamfer::Leg,
                           std::optional<Feed> feed = {});
  void round_corner(const Origin& origin, Length radius, std::optional<Feed> feed = {});
  void chamfer_corner(const Origin& origin, Length size, Chamfer measure = Chamfer::Leg,
                      std::optional<Feed> feed = {});

  /// The block whose move waits for the one that its corner leads to; nullptr: there is none.
  const Origin* open_corner() const;
  /// The waiting move ends in no corner after all.
  void drop_corner();

  /// The ends of the next move are approximate; the center of an arc and this radius are exact.
  /// Where two such moves follow one another, they meet at the intersection nearest to the
  /// programmed point; a line that misses its arc is turned about its other end until it touches. A
  /// point within `tolerance` of an arc is on it.
  void approximate_end(Length tolerance, Length radius = {});
  /// The next move, a line or a straight thread, has this slope (in the plane, from its first axis)
  /// and begins where it meets the move before it, which ends there.
  void back_solve_line(Angle slope, Back which);

  /// The sink from here on; the waiting move goes there too.
  void lead_to(EventSink& sink);
  void lead_to(CompensationSink& sink);
  /// Passed on in its place among the events; dropped where no compensation follows.
  void on_compensation(const compensation::Command& command) override;
  /// An ordinary end of a block where no compensation follows.
  void on_uncounted_block_end(const Origin& event) override;

  /// Ends the waiting move where it is programmed.
  void flush();
  /// No move waiting or announced, no fault, the machine at `start`: no event is given out.
  void reset(const Position& start);

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_block_end(const Origin& event) override;
  void on_thread(const Thread& event) override;

 private:
  friend LookAheadStage;

  bool make_room(const Origin& origin);
  void keep_in_plane(Position& to) const;
  void follow(const Position& to);
  void deliver_own(const compensation::Command& command);
  void deliver_own(const impl::UncountedEnd& end);
  void deliver_own(const impl::CornerPlace& place);

  bool flows_on(const Line& event);
  template <class Move>
  void on_linear(const Move& move, Feed feed, bool rests);
  bool waits(const impl::Element& element) const;
  void take(impl::Element& element);
  void begin_alone(const impl::Element& element);
  void decide_corner(impl::Element& next);
  void lead_back(const Thread& thread);
  bool ends_on_arc(const impl::Element& element, PlaneVector end);
  void finish(const impl::Corner* corner);
  void announce(impl::CornerShape::Kind kind, Length size, std::optional<Feed> feed);
  void shape_waiting(impl::CornerShape::Kind kind, const Origin& origin, Length size,
                     std::optional<Feed> feed);

  Policy policy_;
  CompensationSink* compensation_ = nullptr;  ///< the sink, where compensation follows
  const impl::Corner* corner_ = nullptr;      ///< while the events held at it are delivered
};

}  // namespace dripline::interpreter::blending

namespace dripline::interpreter::look_ahead {
extern template class LookAheadStage<blending::CornerBlender, blending::impl::State,
                                     blending::FaultKind>;
}
