#include "protocol/base/name_lookup.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>

#include "tests/support/silent_lookup.hpp"

namespace dripline {
namespace {

using std::chrono::steady_clock;

NameLookup fixed(HostAddresses addresses) {
  return [addresses = std::move(addresses)](const std::string&) {
    return Result<HostAddresses>(addresses);
  };
}

bool becomes_readable(int descriptor) {
  pollfd polled{.fd = descriptor, .events = POLLIN, .revents = 0};
  return ::poll(&polled, 1, 60'000) == 1;
}

TEST(PendingLookup, ShowsItsResultAtItsDescriptor) {
  const auto pending = PendingLookup::begin("host.example", fixed({"10.0.0.1", "10.0.0.2"}));
  ASSERT_TRUE(pending);
  ASSERT_TRUE(becomes_readable(pending->descriptor()));
  EXPECT_EQ(pending->result()->value(), (HostAddresses{"10.0.0.1", "10.0.0.2"}));
}

TEST(PendingLookup, NeedsNoServerForAnAddress) {
  const test_support::SilentLookup silent;
  const auto pending = PendingLookup::begin("::1", silent.lookup());
  ASSERT_TRUE(pending);
  EXPECT_EQ(pending->result()->value(), HostAddresses{"::1"});
}

TEST(PendingLookup, IsNotWaitedForLonger) {
  const test_support::SilentLookup silent;
  const auto end = steady_clock::now() + std::chrono::milliseconds(50);
  const auto found = addresses_of("host.example", silent.lookup(), end, {});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::Timeout);
}

TEST(PendingLookup, IsBoundedInNumber) {
  {
    const test_support::SilentLookup silent;
    Result<PendingLookup> one = fail(Errc::Io, "none");
    int begun = 0;
    while ((one = PendingLookup::begin("host.example", silent.lookup()))) ++begun;
    EXPECT_EQ(one.error().code, Errc::LimitExceeded);
    EXPECT_LE(begun, PendingLookup::kMax);
    EXPECT_GT(begun, PendingLookup::kMax / 2);
    EXPECT_TRUE(PendingLookup::begin("127.0.0.1", silent.lookup())) << "an address needs none";
  }
  const auto end = steady_clock::now() + std::chrono::minutes(1);
  while (!addresses_of("host.example", fixed({"10.0.0.1"}), end, {}))
    ASSERT_LT(steady_clock::now(), end) << "those that ended make room";
}

TEST(SocketAddress, IsThatOfAText) {
  const auto four = socket_address("127.0.0.1", 80);
  ASSERT_TRUE(four);
  EXPECT_EQ(four->family(), AF_INET);
  sockaddr_in read{};
  std::memcpy(&read, four->get(), sizeof read);
  EXPECT_EQ(ntohs(read.sin_port), 80);
  EXPECT_EQ(socket_address("fd00::a", 80)->family(), AF_INET6);
  EXPECT_EQ(socket_address("localhost", 80).error().code, Errc::Syntax);
}

}  // namespace
}  // namespace dripline
