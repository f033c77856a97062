#include "protocol/dds/configuration.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace dripline::dds {
namespace {

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(DomainConfiguration, ServerHasAFixedPlaceAndNoPeers) {
  const auto xml = domain_configuration({}, Role::Server);
  ASSERT_TRUE(xml);
  EXPECT_TRUE(contains(*xml, "<ParticipantIndex>0<"));
  EXPECT_FALSE(contains(*xml, "<Peer"));
}

TEST(DomainConfiguration, GatewayHasTheServerAsItsOnlyPeer) {
  NetworkOptions options;
  options.domain = 3;
  const auto xml = domain_configuration(options, Role::Gateway);
  ASSERT_TRUE(xml);
  EXPECT_TRUE(contains(*xml, "<ParticipantIndex>none<"));
  EXPECT_TRUE(contains(*xml, R"(<Peer Address="127.0.0.1:8160"/>)"));
}

TEST(DomainConfiguration, APortGivenWithTheServerIsKept) {
  NetworkOptions options;
  options.server = "dnc.example:9000";
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Gateway), "\"dnc.example:9000\""));
}

TEST(DomainConfiguration, NeverUsesMulticastAndStaysOnLoopbackByDefault) {
  for (const Role role : {Role::Server, Role::Gateway}) {
    const auto xml = domain_configuration({}, role);
    EXPECT_TRUE(contains(*xml, R"(<NetworkInterface name="lo" multicast="false"/>)"));
    EXPECT_TRUE(contains(*xml, "<AllowMulticast>false<"));
  }
}

TEST(DomainConfiguration, AnAddressSelectsTheInterfaceByAddress) {
  NetworkOptions options;
  options.interface = "192.168.1.5";
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Server), "address=\"192.168.1.5\""));
}

TEST(DomainConfiguration, OptionsCanNotBreakOutOfTheirPlace) {
  NetworkOptions options;
  options.tag = "</Tag>&\"";
  EXPECT_TRUE(
      contains(*domain_configuration(options, Role::Server), "<Tag>&lt;/Tag&gt;&amp;&quot;</Tag>"));
}

struct BadOption {
  std::string name;
  void (*spoil)(NetworkOptions&);
  Errc code;
  friend std::ostream& operator<<(std::ostream& out, const BadOption& c) { return out << c.name; }
};

class BadNetworkOptions : public testing::TestWithParam<BadOption> {};

TEST_P(BadNetworkOptions, AreRefused) {
  NetworkOptions options;
  GetParam().spoil(options);
  const auto xml = domain_configuration(options, Role::Gateway);
  ASSERT_FALSE(xml);
  EXPECT_EQ(xml.error().code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(
    , BadNetworkOptions,
    testing::Values(
        BadOption{"domain", [](NetworkOptions& o) { o.domain = 231; }, Errc::LimitExceeded},
        BadOption{"interface", [](NetworkOptions& o) { o.interface = "e th"; }, Errc::Syntax},
        BadOption{"server", [](NetworkOptions& o) { o.server = ""; }, Errc::Syntax},
        BadOption{"tag", [](NetworkOptions& o) { o.tag = "a\nb"; }, Errc::Syntax},
        BadOption{"discovery", [](NetworkOptions& o) { o.discovery_interval_ms = 1; },
                  Errc::LimitExceeded},
        BadOption{"lease", [](NetworkOptions& o) { o.lease_ms = 300; }, Errc::LimitExceeded}),
    [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace dripline::dds
