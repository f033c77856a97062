// Any datagram is no announcement, or one whose content survives the round trip; what follows it
// changes nothing.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "tests/support/announcement_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const auto datagram = std::as_bytes(std::span(data, size));
  const auto read = dds::read_announcement(datagram);
  if (!read) return 0;
  if (!std::equal(read->prefix.begin(), read->prefix.end(), datagram.begin() + 8)) __builtin_trap();
  const std::string again = test_support::announcement_bytes(*read);
  if (dds::read_announcement(test_support::as_datagram(again)) != read) __builtin_trap();
  if (dds::read_announcement(test_support::as_datagram(again + "\x01\x01")) != read)
    __builtin_trap();
  return 0;
}
