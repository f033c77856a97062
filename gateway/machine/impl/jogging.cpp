#include "gateway/machine/impl/executor.hpp"
#include "gateway/machine/impl/move_builder.hpp"

/// The part of the executor that moves one axis without a program. Nothing of it is reported to the
/// sink, which knows programs alone.
namespace dripline::machine::impl {

Result<void> Executor::jog(const Jog& jog) {
  if (panel_.emergency_stop) return fail(Errc::Busy, "the emergency stop is pressed");
  if (panel_.feed_override == 0) return fail(Errc::Busy, "the feed override is 0");
  const bool is_free = queue_.empty() && !motion_.is_active() && !is_dwelling_ && speed_ == 0;
  if (!is_free || is_held_ || is_aborting_ || !(stop_ == MachineState::Idle || is_over()))
    return fail(Errc::Busy, "the machine moves, or a program is not over");
  Coordinates target = at_;
  target[static_cast<std::size_t>(jog.axis)] += jog.distance;
  const Path path = straight_path(at_, target);
  if (!(path.length > 0)) return fail(Errc::LimitExceeded, "the distance is too small to move by");
  MoveBuilder builder(limits_);
  builder.show_as(jog.display);
  const MoveTask task{.path = path,
                      .pace = Pace::Feed,
                      .feed = Feed::per_minute(Length::mm(jog.feed_per_minute)),
                      .lead = {}};
  if (auto refusal = builder.build(task, spindle_, jog_move_))
    return fail(Errc::LimitExceeded, "{}", refusal->text);
  jog_move_.exit_square = 0;
  is_jogging_ = true;
  is_jog_stopping_ = false;
  motion_.start(jog_move_, 0, goal(jog_move_));
  return {};
}

void Executor::stop_jog() {
  if (!is_jogging_ || is_jog_stopping_) return;
  is_jog_stopping_ = true;
  motion_.change(goal(jog_move_));
}

/// At its end, or at rest before it.
void Executor::end_jog() {
  at_ = motion_.reaches_end() ? jog_move_.path.to : position();
  motion_.stop();
  is_jogging_ = false;
}

}  // namespace dripline::machine::impl
