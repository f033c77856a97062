// A command to the node of Sparkplug B, as any client of the broker can send it. Properties: births
// are asked for only by bytes that name the wish; what is after the command changes nothing.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "server/mqtt/sparkplug_payload.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const bool asks = mqtt::asks_rebirth(bytes);
  if (asks && bytes.find(mqtt::kRebirth) == std::string::npos) std::abort();
  // A metric of another node.
  static const std::string more = mqtt::encode(
      {.time = UtcTime{}, .seq = {}, .metrics = {{"X", mqtt::Metric::Type::Double, 1.0}}});
  if (asks && !mqtt::asks_rebirth(bytes + more)) std::abort();
  return 0;
}
