#include "gateway/app/order_validity.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::gateway {

std::optional<std::string> OrderValidity::refusal(const dds::Order& order, SteadyTime now) const {
  using std::chrono::microseconds;
  if (order.deadline == microseconds{0} || order.server == 0 || order.session != session_) {
    return fmt::format(
        "the order names no session and deadline: the server is older than protocol {}",
        dds::kProtocolVersion);
  }
  const auto time = std::chrono::duration_cast<microseconds>(now.time_since_epoch());
  if (time > order.deadline) {
    return fmt::format("the order came {:.1f} s after its deadline",
                       std::chrono::duration<double>(time - order.deadline).count());
  }
  if (order.server == server_ && order.number < last_stop_)
    return "a later order has stopped the machine meanwhile";
  return std::nullopt;
}

void OrderValidity::note_stop(const dds::Order& order) {
  if (order.server != server_) last_stop_ = 0;
  server_ = order.server;
  last_stop_ = std::max(last_stop_, order.number);
}

}  // namespace dripline::gateway
