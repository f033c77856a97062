#include "server/api/request.hpp"

#include <gtest/gtest.h>

#include "server/api/api.hpp"
#include "server/api/http_address.hpp"

namespace dripline::api {
namespace {

TEST(ParseTarget, CutsBeforeItDecodes) {
  const auto target = parse_target("/api/v1/programs/a%2Fb%20c?x=1%262&y=a+b&z");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->segments, (std::vector<std::string>{"api", "v1", "programs", "a/b c"}));
  EXPECT_EQ(target->query.at("x"), "1&2");
  EXPECT_EQ(target->query.at("y"), "a b");
  EXPECT_EQ(target->query.at("z"), "");
}

TEST(ParseTarget, RefusesWhatIsNoPath) {
  for (const std::string text :
       {"", "api", "/a%2", "/a%zz", "/a%00", "/a?x=1&x=2", "/?%", "/a?x=%0"}) {
    EXPECT_FALSE(parse_target(text)) << text;
  }
  EXPECT_EQ(parse_target("/" + std::string(5000, 'a')).error().code, Errc::LimitExceeded);
}

struct RangeCase {
  const char* header;
  std::optional<ByteRange> range;
  std::optional<Errc> error;
};

TEST(ParseByteRange, KnowsTheThreeForms) {
  const RangeCase cases[] = {
      {"", {}, {}},
      {"bytes=0-3", ByteRange{0, 4}, {}},
      {"bytes=9-", ByteRange{9, 1}, {}},
      {"bytes=5-99", ByteRange{5, 5}, {}},
      {"bytes=-4", ByteRange{6, 4}, {}},
      {"bytes=-99", ByteRange{0, 10}, {}},
      {"bytes=10-", {}, Errc::LimitExceeded},
      {"bytes=-0", {}, Errc::LimitExceeded},
      {"bytes=5-4", {}, Errc::LimitExceeded},
      {"bytes=1-2,4-5", {}, Errc::Unsupported},
      {"bytes=-", {}, Errc::Syntax},
      {"bytes=a-b", {}, Errc::Syntax},
      {"lines=1-2", {}, Errc::Syntax},
  };
  for (const auto& c : cases) {
    const auto range = parse_byte_range(c.header, 10);
    ASSERT_EQ(range.has_value(), !c.error) << c.header;
    if (c.error) {
      EXPECT_EQ(range.error().code, *c.error) << c.header;
      continue;
    }
    ASSERT_EQ(range->has_value(), c.range.has_value()) << c.header;
    if (!c.range) continue;
    EXPECT_EQ((*range)->first, c.range->first) << c.header;
    EXPECT_EQ((*range)->length, c.range->length) << c.header;
  }
}

TEST(HttpAddress, KnowsWhatStaysOnThisMachine) {
  EXPECT_TRUE(parse_http_address("127.0.0.1:8430")->is_loopback);
  EXPECT_TRUE(parse_http_address("localhost:0")->is_loopback);
  EXPECT_TRUE(parse_http_address("[::1]:1")->is_loopback);
  EXPECT_FALSE(parse_http_address("0.0.0.0:8430")->is_loopback);
  EXPECT_FALSE(parse_http_address("[::]:8430")->is_loopback);
  EXPECT_FALSE(parse_http_address("192.168.1.2:8430")->is_loopback);
  EXPECT_EQ(parse_http_address("[::1]:80")->text(), "[::1]:80");
  for (const char* text : {"", "localhost", "localhost:x", "localhost:65536", "nohost:80", ":80"}) {
    EXPECT_FALSE(parse_http_address(text)) << text;
  }
}

TEST(HttpAddress, IsRefusedBeyondThisMachineWithoutTls) {
  const auto everywhere = parse_http_address("0.0.0.0:8430").value();
  EXPECT_EQ(check_exposure(everywhere, false).error().code, Errc::Denied);
  EXPECT_TRUE(check_exposure(everywhere, true));
  EXPECT_TRUE(check_exposure(parse_http_address("127.0.0.1:1").value(), false));
}

}  // namespace
}  // namespace dripline::api
