#include "protocol/dds/configuration.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <ostream>
#include <set>

#include "protocol/base/descriptor.hpp"

namespace dripline::dds {
namespace {

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST(DomainConfiguration, ServerHasAFixedPlaceAndNoPeers) {
  const auto xml = domain_configuration({}, Role::Server, 0);
  ASSERT_TRUE(xml);
  EXPECT_TRUE(contains(*xml, "<ParticipantIndex>0<"));
  EXPECT_FALSE(contains(*xml, "<Peer"));
}

TEST(DomainConfiguration, GatewayHasTheServerAsItsOnlyPeer) {
  NetworkOptions options;
  options.domain = 3;
  const auto xml = domain_configuration(options, Role::Gateway, 0);
  ASSERT_TRUE(xml);
  EXPECT_TRUE(contains(*xml, "<ParticipantIndex>none<"));
  EXPECT_TRUE(contains(*xml, R"(<Peer Address="127.0.0.1:8160"/>)"));
}

TEST(DomainConfiguration, APortGivenWithTheServerIsKept) {
  NetworkOptions options;
  options.server = "dnc.example:9000";
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Gateway, 0), "\"dnc.example:9000\""));
}

TEST(DomainConfiguration, SeveralServersAreAllPeers) {
  NetworkOptions options;
  options.domain = 3;
  options.server = "srv-1,srv-2:9000";
  const auto xml = domain_configuration(options, Role::Gateway, 1);
  ASSERT_TRUE(xml) << xml.error().what;
  EXPECT_TRUE(contains(*xml, R"(<Peers><Peer Address="srv-1:8162"/><Peer Address="srv-2:9002"/>)"));
  for (const std::string wrong : {"srv-1,", ",srv-1", "srv-1,,srv-2", "srv-1,srv-2:x"}) {
    options.server = wrong;
    EXPECT_EQ(domain_configuration(options, Role::Gateway, 0).error().code, Errc::Syntax) << wrong;
  }
  options.server = "a,b,c,d,e,f,g,h,i";
  EXPECT_EQ(domain_configuration(options, Role::Gateway, 0).error().code, Errc::LimitExceeded);
}

TEST(DomainConfiguration, AServerListensAtThePortItIsGiven) {
  NetworkOptions options;
  options.domain = 3;
  options.port = 9000;
  const auto xml = domain_configuration(options, Role::Server, 2);
  ASSERT_TRUE(xml) << xml.error().what;
  EXPECT_TRUE(contains(*xml, "<Base>8994</Base><DomainGain>0</DomainGain>"));
  options.port = 80;
  EXPECT_EQ(domain_configuration(options, Role::Server, 0).error().code, Errc::LimitExceeded);
  options.port = 65530;
  EXPECT_EQ(domain_configuration(options, Role::Server, 0).error().code, Errc::LimitExceeded);
}

TEST(DomainConfiguration, EachCellHasItsOwnPorts) {
  NetworkOptions options;
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Server, 3), "<Base>7406<"));
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Gateway, 3), "\"127.0.0.1:7416\""));
  options.server = "dnc.example:9000";
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Gateway, 3), "\"dnc.example:9006\""));
}

// The cell of a machine is part of the protocol: it must never change.
TEST(CellOf, StaysWhatItAlwaysWas) {
  EXPECT_EQ(cell_of("lathe-1"), 5U);
  EXPECT_EQ(cell_of("lathe-2"), 7U);
}

TEST(CellOf, UsesEveryCell) {
  std::set<std::uint32_t> cells;
  for (int i = 0; i < 100; ++i) cells.insert(cell_of(fmt::format("m{}", i)));
  EXPECT_EQ(cells.size(), kFewestCells);
}

TEST(CellOf, ASixtyFourthHasAsManyPortsAsADomainHas) {
  NetworkOptions options;
  options.cells = kMostCells;
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Gateway, 63), "\"127.0.0.1:7536\""));
  EXPECT_LT(server_port(0, kMostCells - 1) + 1, server_port(1, 0));
}

TEST(TakesMachine, AlsoWhereAGatewayWithFewerCellsLooksForIt) {
  for (int i = 0; i < 100; ++i) {
    const std::string machine = fmt::format("m{}", i);
    std::set<std::uint32_t> expected, taken;
    for (const std::uint32_t cells : {8U, 16U, 32U, 64U}) expected.insert(cell_of(machine, cells));
    for (std::uint32_t cell = 0; cell < kMostCells; ++cell) {
      if (takes_machine(machine, cell, kMostCells)) taken.insert(cell);
    }
    EXPECT_EQ(taken, expected) << machine;
  }
}

TEST(DomainConfiguration, NeverUsesMulticastAndStaysOnLoopbackByDefault) {
  for (const Role role : {Role::Server, Role::Gateway}) {
    const auto xml = domain_configuration({}, role, 0);
    EXPECT_TRUE(contains(*xml, R"(<NetworkInterface name="lo" multicast="false"/>)"));
    EXPECT_TRUE(contains(*xml, "<AllowMulticast>false<"));
  }
}

TEST(DomainConfiguration, AnAddressSelectsTheInterfaceByAddress) {
  NetworkOptions options;
  options.interface = "192.168.1.5";
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Server, 0), "address=\"192.168.1.5\""));
}

TEST(DomainConfiguration, OptionsCannotBreakOutOfTheirPlace) {
  NetworkOptions options;
  options.tag = "</Tag>&\"";
  EXPECT_TRUE(contains(*domain_configuration(options, Role::Server, 0),
                       "<Tag>&lt;/Tag&gt;&amp;&quot;</Tag>"));
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
  const auto xml = domain_configuration(options, Role::Gateway, 0);
  ASSERT_FALSE(xml);
  EXPECT_EQ(xml.error().code, GetParam().code);
}

INSTANTIATE_TEST_SUITE_P(
    , BadNetworkOptions,
    testing::Values(
        BadOption{"domain", [](NetworkOptions& o) { o.domain = 231; }, Errc::LimitExceeded},
        BadOption{"interface", [](NetworkOptions& o) { o.interface = "e th"; }, Errc::Syntax},
        BadOption{"server", [](NetworkOptions& o) { o.server = ""; }, Errc::Syntax},
        BadOption{"port", [](NetworkOptions& o) { o.server = "host:70000"; }, Errc::Syntax},
        BadOption{"tag", [](NetworkOptions& o) { o.tag = "a\nb"; }, Errc::Syntax},
        BadOption{"discovery", [](NetworkOptions& o) { o.discovery_interval_ms = 1; },
                  Errc::LimitExceeded},
        BadOption{"cells", [](NetworkOptions& o) { o.cells = 9; }, Errc::LimitExceeded},
        BadOption{"no_cells", [](NetworkOptions& o) { o.cells = 0; }, Errc::LimitExceeded},
        BadOption{"many_cells", [](NetworkOptions& o) { o.cells = 128; }, Errc::LimitExceeded},
        BadOption{"lease", [](NetworkOptions& o) { o.lease_ms = 300; }, Errc::LimitExceeded}),
    [](const auto& i) { return i.param.name; });

TEST(ServerPorts, AreFoundInUseBeforeAServerIsOpened) {
  NetworkOptions options;
  options.port = 20000;
  while (!check_ports(options) && options.port < 30000)
    options.port = static_cast<std::uint16_t>(options.port + 2 * kFewestCells);
  ASSERT_TRUE(check_ports(options));
  const Descriptor other(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  const auto last = static_cast<std::uint16_t>(options.port + 2 * kFewestCells - 1);
  place.sin_port = htons(last);
  ASSERT_EQ(::bind(other.get(), reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  const auto taken = check_ports(options);
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, Errc::Busy);
  EXPECT_TRUE(contains(taken.error().what, "UDP port " + std::to_string(last) + " is in use"))
      << taken.error().what;
}

}  // namespace
}  // namespace dripline::dds
