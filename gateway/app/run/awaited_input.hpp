#pragma once

#include <optional>

#include "gateway/interpreter/core/interpreter.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::gateway {

/// A program's wait for an input pin. As LinuxCNC has it, a rise is that the pin is low and then
/// high: one that is high already has to go low first. Value type.
class AwaitedInput {
 public:
  AwaitedInput(const interpreter::InputQuestion& question, SteadyTime now);
  /// The pin as it is now. Whether the wait is fulfilled, or over; nothing: it continues.
  std::optional<bool> look(bool state, SteadyTime now);

 private:
  interpreter::InputWait wait_;
  SteadyTime end_;
};

}  // namespace dripline::gateway
