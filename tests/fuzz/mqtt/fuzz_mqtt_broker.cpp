// Whatever a broker sends. Bits of the first byte: with MQTT 5, or 3.1.1; after it has accepted us
// and three messages were published, or from the beginning. Properties: pieces of any size end in
// the same; nothing is acknowledged that was not published, nor twice; what is held is bounded.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>

#include "server/mqtt/client_session.hpp"

namespace {

using namespace dripline;

std::string play(std::string_view bytes, unsigned how, std::size_t piece) {
  const bool is_version_5 = (how & 1U) != 0, is_accepted = (how & 2U) != 0;
  mqtt::ClientSession session({.client_id = "c",
                               .user = {},
                               .password = {},
                               .keep_alive = 20,
                               .is_version_5 = is_version_5});
  const SteadyTime now{};
  if (!session.begin({"w", "x", 1, true}, "wish", now)) std::abort();
  const std::string_view accepted("\x20\x03\0\0\0", 5), accepted_311("\x20\x02\0\0", 4);
  if (is_accepted) {
    if (!session.receive(is_version_5 ? accepted : accepted_311, now)) std::abort();
    for (const int qos : {1, 2, 2})
      if (!session.publish({"t", "x", qos, false})) std::abort();
  }
  std::string result;
  std::set<std::uint64_t> acknowledged;
  while (!bytes.empty()) {
    const auto received = session.receive(bytes.substr(0, piece), now);
    bytes.remove_prefix(std::min(piece, bytes.size()));
    for (const auto& [message, refusal] : session.take_acknowledged()) {
      const bool is_ours = is_accepted && message >= 1 && message <= 3;
      if (!is_ours || !acknowledged.insert(message).second) std::abort();
      result += std::to_string(message) + refusal + "\n";
    }
    for (const auto& payload : session.take_received()) {
      if (payload.size() > mqtt::ClientSession::kMaxReceivedSize) std::abort();
    }
    if (!received) return result + received.error().what;
  }
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::string_view sent = std::string_view(bytes).substr(1);
  if (play(sent, data[0], sent.size()) != play(sent, data[0], 1)) std::abort();
  return 0;
}
