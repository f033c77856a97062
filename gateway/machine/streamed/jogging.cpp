// One axis by a distance, without a program.
#include <cmath>

#include "gateway/machine/streamed/motion_writer.hpp"
#include "gateway/machine/streamed/streamed_machine.hpp"

namespace dripline::machine::streamed {

Result<void> StreamedMachine::begin_jog(const Jog& jog) {
  if (is_emergency_) return fail(Errc::Busy, "the emergency stop is pressed");
  if (is_override_hold_) return fail(Errc::Busy, "the feed or rapid override is 0");
  if (is_active_ || device_.is_jogging()) return fail(Errc::Busy, "the machine moves already");
  if (auto ready = check_device(); !ready) return ready;
  const TextRules& rules = device_.rules();
  const auto axis = static_cast<std::size_t>(jog.axis);
  if (!rules.has(axis))
    return fail(Errc::Unsupported, "this machine has no axis {}", interpreter::letter(jog.axis));
  const double step = 1 / rules.axes[axis]->steps;
  if (!(std::fabs(jog.distance) >= step && jog.feed_per_minute > 0))
    return fail(Errc::LimitExceeded, "{} is less than a step of the axis, {:.4g}", jog.distance,
                step);
  Coordinates target = device_.position();
  target[axis] += jog.distance;
  if (auto refusal = check_travel(rules, device_.position(), target, jog.display))
    return fail(Errc::LimitExceeded, "{}", refusal->text);
  return device_.jog(jog, now());
}

Result<void> StreamedMachine::jog(const Jog& jog) {
  auto begun = [&] {
    const Lock lock(mutex_);
    return begin_jog(jog);
  }();
  wake();
  return begun;
}

bool StreamedMachine::is_jogging() const {
  const Lock lock(mutex_);
  return device_.is_jogging();
}

void StreamedMachine::stop_jog() {
  {
    const Lock lock(mutex_);
    device_.stop_jog(now());
  }
  wake();
}

std::string StreamedMachine::jog_fault() const {
  const Lock lock(mutex_);
  return device_.jog_fault();
}

}  // namespace dripline::machine::streamed
