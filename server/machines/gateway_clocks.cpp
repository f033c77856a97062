#include "server/machines/gateway_clocks.hpp"

#include <algorithm>

namespace dripline::machines {

using std::chrono::microseconds;

void GatewayClocks::compare(const dds::Status& status, UtcTime now, SteadyTime steady_now) {
  if (status.steady == microseconds{0}) return;  // from a gateway that does not report it
  steady_ahead_ =
      status.steady - std::chrono::duration_cast<microseconds>(steady_now.time_since_epoch());
  time_ahead_[count_++ % kSamples] = status.time - now;
}

std::optional<microseconds> GatewayClocks::time_ahead() const {
  if (count_ < kSamples) return std::nullopt;
  return *std::max_element(time_ahead_.begin(), time_ahead_.end());
}

}  // namespace dripline::machines
