#include "protocol/serial/address.hpp"

#include <gtest/gtest.h>

namespace dripline::serial {
namespace {

TEST(ParseAddress, TakesADevice) {
  EXPECT_EQ(*parse_address("/dev/ttyUSB0"), Address(TtyAddress{"/dev/ttyUSB0"}));
}

TEST(ParseAddress, TakesADeviceServer) {
  EXPECT_EQ(*parse_address("tcp://moxa-3:4001"), Address(TcpAddress{"moxa-3", 4001, false}));
  EXPECT_EQ(*parse_address("rfc2217://10.0.0.7:2001"), Address(TcpAddress{"10.0.0.7", 2001, true}));
  EXPECT_EQ(*parse_address("tcp://[fd00::3]:4001"), Address(TcpAddress{"fd00::3", 4001, false}));
}

struct Refused {
  const char* name;
  const char* text;
  Errc code;
  const char* named;
};
class ParseAddressRefuses : public testing::TestWithParam<Refused> {};

TEST_P(ParseAddressRefuses, AndReportsTheError) {
  const auto parsed = parse_address(GetParam().text);
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().code, GetParam().code);
  EXPECT_NE(parsed.error().what.find(GetParam().named), std::string::npos) << parsed.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , ParseAddressRefuses,
    testing::Values(Refused{"relative", "ttyUSB0", Errc::Syntax, "ttyUSB0"},
                    Refused{"empty", "", Errc::Syntax, "neither"},
                    Refused{"slash", "/", Errc::Syntax, "neither"},
                    Refused{"other_scheme", "http://a:1", Errc::Syntax, "http"},
                    Refused{"no_port", "tcp://moxa", Errc::Syntax, "host:port"},
                    Refused{"no_host", "tcp://:4001", Errc::Syntax, "host:port"},
                    Refused{"empty_brackets", "tcp://[]:4001", Errc::Syntax, "host"},
                    Refused{"bare_ipv6", "tcp://fd00::3:4001", Errc::Syntax, "[address]:port"},
                    Refused{"word", "tcp://moxa:telnet", Errc::Syntax, "telnet"},
                    Refused{"port_0", "tcp://moxa:0", Errc::LimitExceeded, "0"},
                    Refused{"port_65536", "tcp://moxa:65536", Errc::LimitExceeded, "65536"},
                    Refused{"port_huge", "tcp://moxa:99999999999999999999999", Errc::LimitExceeded,
                            "65535"}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::serial
