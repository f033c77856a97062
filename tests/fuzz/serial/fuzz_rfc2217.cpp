#include <algorithm>
#include <cstdlib>

#include "protocol/serial/rfc2217.hpp"

namespace {

using dripline::serial::Rfc2217Client;

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

/// Whatever a device server sends: answers stay as short as what they answer, and characters that
/// we encode come out of another end unchanged.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> input(reinterpret_cast<const std::byte*>(data), size);
  Rfc2217Client client;
  client.take_replies();
  std::size_t replied = 0;
  for (const std::byte byte : input) {
    (void)client.feed(byte);
    replied += client.take_replies().size();
  }
  require(replied <= size + 2);

  std::vector<std::byte> traveling, arrived;
  const Rfc2217Client sender;  // before the binary option is agreed: the harder case
  sender.encode(input, traveling);
  Rfc2217Client receiver;
  for (const std::byte byte : traveling) {
    const auto event = receiver.feed(byte);
    if (!event) continue;
    require(std::holds_alternative<std::byte>(*event));
    arrived.push_back(std::get<std::byte>(*event));
  }
  require(std::equal(arrived.begin(), arrived.end(), input.begin(), input.end()));
  return 0;
}
