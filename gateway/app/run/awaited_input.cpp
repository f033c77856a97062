#include "gateway/app/run/awaited_input.hpp"

#include <algorithm>
#include <chrono>

namespace dripline::gateway {

using interpreter::InputWait;

AwaitedInput::AwaitedInput(const interpreter::InputQuestion& question, SteadyTime now)
    : wait_(question.wait) {
  constexpr double kLongest = 1e7;  // seconds; a clock counts nanoseconds
  const std::chrono::duration<double> seconds{std::clamp(question.seconds, 0.0, kLongest)};
  end_ = now + std::chrono::duration_cast<SteadyTime::duration>(seconds);
}

std::optional<bool> AwaitedInput::look(bool state, SteadyTime now) {
  if ((wait_ == InputWait::High && state) || (wait_ == InputWait::Low && !state)) return true;
  if (wait_ == InputWait::Rise && !state) wait_ = InputWait::High;
  if (wait_ == InputWait::Fall && state) wait_ = InputWait::Low;
  if (now >= end_) return false;
  return std::nullopt;
}

}  // namespace dripline::gateway
