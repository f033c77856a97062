// Axes that move without a program: one by a distance, and all to their reference points.
#include <cmath>

#include "gateway/machine/linuxcnc/session.hpp"

namespace dripline::machine::linuxcnc {

/// The direction is the velocity's sign, whatever that of the distance is.
Result<void> Session::jog(const Jog& jog, SteadyTime now) {
  const auto axis = static_cast<std::size_t>(jog.axis);
  const double unit = interpreter::is_rotary(jog.axis) ? 1 : hello_->units_per_mm;
  const double velocity = std::copysign(jog.feed_per_minute / 60 * unit, jog.distance);
  last_error_.clear();
  jog_fault_.clear();
  jog_ = JogInHand{
      .axis = axis, .to = position_[axis] + jog.distance, .at = status_->at, .still_since = now};
  jog_->number = command(fmt::format(R"("do":"jog","axis":{},"velocity":{:.9f},"distance":{:.9f})",
                                     axis, velocity, std::fabs(jog.distance) * unit));
  return {};
}

void Session::stop_jog(SteadyTime) {
  if (!jog_ || jog_->is_stopped) return;
  jog_->is_stopped = true;
  command(fmt::format(R"("do":"stop_jog","axis":{})", jog_->axis));
}

void Session::end_jog(std::string fault) {
  jog_.reset();
  jog_fault_ = std::move(fault);
}

/// LinuxCNC reports no end of a jog: it has ended when the axes have stood still for a moment since
/// the command was handed over.
void Session::watch_jog(SteadyTime now) {
  constexpr double kReached = 1e-4;
  if (!jog_) return;
  if (status_->state != TaskState::On)
    return end_jog(with_message("LinuxCNC has turned the machine off"));
  if (status_->at != jog_->at || shown_number_ < jog_->number) {
    jog_->at = status_->at;
    jog_->still_since = now;
    return;
  }
  const bool is_there = std::fabs(position_[jog_->axis] - jog_->to) < kReached;
  const auto needed = is_there || jog_->is_stopped ? limits_.still : limits_.late;
  if (now - jog_->still_since < needed) return;
  const bool has_message = !is_there && !jog_->is_stopped && !last_error_.empty();
  end_jog(has_message ? last_error_ : std::string());
}

bool Session::is_homing() const {
  return phase_ == Phase::Ready && status_ && !is_active_ && (status_->is_homing || homing_);
}

/// It overtakes what the helper has not sent of the homing yet.
void Session::stop_homing(SteadyTime now) {
  if (is_homing()) abort(now);
}

/// LinuxCNC homes one group of axes after another: between two of them none is.
void Session::watch_homing(SteadyTime now) {
  if (!homing_) return;
  if (status_->is_homing || shown_number_ < homing_->number)
    homing_->seen = now;
  else if (now - homing_->seen > limits_.late)
    homing_.reset();
}

}  // namespace dripline::machine::linuxcnc
