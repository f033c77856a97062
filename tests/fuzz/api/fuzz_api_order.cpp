// The body of POST /runs/{id}/orders. Property: a value that is taken can be sent to a machine.
#include <cmath>
#include <cstdlib>

#include "server/api/bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto order = api::decode_order({reinterpret_cast<const char*>(data), size});
  if (!order) return order.error().what.empty() ? (std::abort(), 0) : 0;
  if (!std::isfinite(order->value) || order->value < 0 || order->value > api::kMaxOverride) {
    std::abort();
  }
  if (order->action == dds::OrderAction::Start || order->argument.size() > 255) std::abort();
  if (order->argument.find('\0') != std::string::npos) std::abort();
  return 0;
}
