#include "protocol/dds/discovery_packet.hpp"

#include <gtest/gtest.h>

#include "tests/support/announcement_bytes.hpp"

namespace dripline::dds {
namespace {

using test_support::announcement_bytes;
using test_support::as_datagram;

ParticipantAnnouncement a_gateway(const std::string& tag = "shop") {
  ParticipantAnnouncement made{.prefix = {}, .domain = 3, .tag = tag};
  for (std::size_t i = 0; i < made.prefix.size(); ++i)
    made.prefix.at(i) = static_cast<std::byte>(i + 1);
  return made;
}

std::optional<ParticipantAnnouncement> read_bytes(const std::string& bytes) {
  return read_announcement(as_datagram(bytes));
}

std::string bytes_of_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  return bytes;
}

/// As Cyclone DDS 0.10.2 has sent it: domain 3, tag "mytag", after a time stamp.
constexpr const char* kCaptured =
    "52545053020101100110ced8aa3450242303a39009010800fb140e6bc000ade215053c010000100000000000000100"
    "c200000000010000000003000059005800030000000e0000005f5f50726f636573734e616d6500000006000000646e"
    "636777000000060000005f5f5069640000000600000033313839340000000b0000005f5f486f73746e616d65000003"
    "000000766d00000000000015000400020100001600040001100000020008000200000000000000500010000110ced8"
    "aa3450242303a390000001c1580004003ffc00000f0004000300000014400c00060000006d79746167000000310018"
    "0001000000939700000000000000000000000000007f00000132001800010000009397000000000000000000000000"
    "00007f00000107803000000000002c00000000000000000000000000000016000000766d2f302e31302e322f4c696e"
    "75782f4c696e7578000000198004000000200001000000";

TEST(DiscoveryPacket, IsReadAsCycloneSendsIt) {
  const auto announcement = read_bytes(bytes_of_hex(kCaptured));
  ASSERT_TRUE(announcement);
  EXPECT_EQ(announcement->domain, 3u);
  EXPECT_EQ(announcement->tag, "mytag");
  EXPECT_EQ(announcement->prefix.front(), std::byte{0x01});
  EXPECT_EQ(announcement->prefix.back(), std::byte{0x90});
}

TEST(DiscoveryPacket, NamesParticipantDomainAndTag) {
  EXPECT_EQ(read_bytes(announcement_bytes(a_gateway())), a_gateway());
  EXPECT_EQ(read_bytes(announcement_bytes(a_gateway(""))), a_gateway(""));
}

TEST(DiscoveryPacket, ThatIsCutOffIsNone) {
  const std::string whole = announcement_bytes(a_gateway());
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(read_bytes(whole.substr(0, size))) << size;
}

/// Of `whole` with this byte changed.
void expect_none(std::size_t at, char byte) {
  std::string bytes = announcement_bytes(a_gateway());
  ASSERT_LT(at, bytes.size());
  bytes[at] = byte;
  EXPECT_FALSE(read_bytes(bytes)) << at;
}

TEST(DiscoveryPacket, OtherTrafficIsNone) {
  expect_none(0, 'X');      // the magic
  expect_none(4, 3);        // another major version
  expect_none(20, 0x07);    // a heartbeat
  expect_none(21, 1);       // without data: the participant's end
  expect_none(35, '\xC7');  // another writer
  expect_none(45, 1);       // not a list of parameters
  expect_none(52, 9);       // another participant's GUID than the sender's
  EXPECT_FALSE(read_bytes(""));
  EXPECT_FALSE(read_bytes("RTPS"));
}

}  // namespace
}  // namespace dripline::dds
