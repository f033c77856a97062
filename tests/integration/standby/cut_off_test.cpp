// An active server that reaches the database and no gateway: the other one has the library soon,
// and they do not swap for ever.
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>

#include "tests/integration/standby/fed_machine.hpp"
#include "tests/support/announcement_bytes.hpp"
#include "tests/support/network_namespace.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::eventually;
using SteadyNow = std::chrono::steady_clock;

/// Looks often enough that it would see a library that moves.
class CutOffTest : public FedMachineTest {
 protected:
  std::string term() const {
    return connect().text("SELECT CAST(term AS text) FROM store_holder").value_or("");
  }
  std::string server_shown(int server) const {
    return shop_->rest(server).get("/api/v1/server").body;
  }
  bool shows(int server, const std::string& text) const {
    return eventually([&] { return server_shown(server).find(text) != std::string::npos; },
                      seconds(60));
  }
  std::string trail(int server) const { return shop_->rest(server).get("/api/v1/audit").body; }
  /// For twice as long as a hand-over of its own would need.
  void expect_it_stays(int server) const {
    const std::string before = term();
    for (const auto until = SteadyNow::now() + seconds(8); SteadyNow::now() < until;) {
      ASSERT_EQ(shop_->role(server), "active") << shop_->log(server);
      std::this_thread::sleep_for(milliseconds(250));
    }
    EXPECT_EQ(term(), before);
  }
};

/// The first server has a network of its own, with one cable to that of the other one and of the
/// gateway. The database is reached without it.
class CutCable : public CutOffTest {
 protected:
  void SetUp() override {
    CutOffTest::SetUp();
    if (IsSkipped()) return;
    office_ = test_support::NetworkNamespace::make();
    hall_ = test_support::NetworkNamespace::make();
    if (!office_ || !hall_ || !office_->connect(*hall_, "10.77.0.1/24", "10.77.0.2/24"))
      GTEST_SKIP() << "network namespaces are not permitted here";
    inside_.emplace(hall_->path());
    shop_.emplace(TwoServers::Options{.stores = {url_of('a'), url_of('b')},
                                      .speed = "10x",
                                      .arguments = {"--handover-s", "3"},
                                      .addresses = {"10.77.0.1", "10.77.0.2"},
                                      .interface = "cable",
                                      .first_network = office_->path()});
    start_both();
  }
  /// Without a cable of the test: that would be in one of the networks alone.
  std::string url_of(char server) const {
    return database_->url() + "&options=-c%20dripline.server%3D" + server;
  }

  std::unique_ptr<test_support::NetworkNamespace> office_, hall_;
  std::optional<test_support::InNetwork> inside_;
};

TEST_F(CutCable, TheMachineIsFedByTheOtherServerAndTheLibraryStaysThere) {
  constexpr std::uint64_t kLines = 1500;
  const std::string id = begin_run(kLines);
  if (HasFailure()) return;
  ASSERT_TRUE(shows(0, "hears 1 gateway\"")) << server_shown(0) << shop_->log(1);
  levels_->reset();
  const auto full = eventually([&] { return levels_->now().samples > 20; });
  ASSERT_TRUE(full);
  const auto begun = SteadyNow::now();
  ASSERT_TRUE(office_->ip("link set cable down"));
  ASSERT_TRUE(shop_->wait_active(1, seconds(60))) << shop_->log(0) << shop_->log(1);
  ASSERT_TRUE(shop_->wait_connected(1)) << shop_->log(1);
  const auto took = std::chrono::duration_cast<milliseconds>(SteadyNow::now() - begun);
  std::this_thread::sleep_for(milliseconds(500));  // until text flows again
  const auto level = levels_->now();
  fmt::print("fed again after {} ms, least text {} of {} bytes\n", took.count(), level.least,
             level.most);
  EXPECT_FALSE(level.has_ended) << "the run ended during the test: it is too short";
  // Ten seconds of text: a computer that is busy takes longer, and the machine may wait.
  if (took < milliseconds(4500)) {
    EXPECT_GE(level.least * 2, level.most);
  }
  EXPECT_NE(shop_->log(0).find("this server hears no gateway, and one that waits hears 1"),
            std::string::npos)
      << shop_->log(0);
  EXPECT_NE(shop_->log(1).find("has given the library back"), std::string::npos) << shop_->log(1);
  EXPECT_NE(trail(1).find("server.hand_over"), std::string::npos) << trail(1);

  ASSERT_TRUE(shows(1, "hears 0 gateways")) << server_shown(1);
  ASSERT_TRUE(office_->ip("link set cable up"));
  ASSERT_TRUE(shows(1, "hears 1 gateway\"")) << "the cable is there: " << server_shown(1);
  expect_it_stays(1);
  expect_whole_run(1, id, kLines, seconds(240));
}

class SilentShop : public CutOffTest {
 protected:
  void begin_with_gateway() {
    begin({"--handover-s", "3"});
    shop_->start_gateway();
    ASSERT_TRUE(shop_->wait_connected(0)) << shop_->gateway_log();
    ASSERT_TRUE(shows(0, "hears 1 gateway\"")) << server_shown(0) << shop_->log(1);
  }
  /// Announcements of gateways that do not exist, to the ports of this server.
  std::jthread forge_at(int server, int gateways) const {
    return std::jthread([this, server, gateways](const std::stop_token& stop) {
      const Descriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
      sockaddr_in place{};
      place.sin_family = AF_INET;
      place.sin_port = htons(shop_->dds_port(server));
      place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      while (!stop.stop_requested()) {
        for (int i = 1; i <= gateways; ++i) {
          dds::ParticipantAnnouncement forged{.prefix = {},
                                              .domain = static_cast<std::uint32_t>(shop_->domain()),
                                              .tag = shop_->tag()};
          forged.prefix.fill(static_cast<std::byte>(i));
          const std::string bytes = test_support::announcement_bytes(forged);
          (void)::sendto(socket.get(), bytes.data(), bytes.size(), 0,
                         reinterpret_cast<const sockaddr*>(&place), sizeof place);
        }
        std::this_thread::sleep_for(milliseconds(100));
      }
    });
  }
};

TEST_F(SilentShop, MachinesThatAreSwitchedOffMoveNothing) {
  begin_with_gateway();
  shop_->gateway().kill();
  ASSERT_TRUE(shows(0, "hears 0 gateways")) << server_shown(0);
  expect_it_stays(0);
  EXPECT_EQ(server_shown(0).find("\"gateways\""), std::string::npos) << server_shown(0);
}

TEST_F(SilentShop, ForgedGatewaysMoveNothingWhileOneIsHeard) {
  begin_with_gateway();
  const auto forger = forge_at(1, 5);
  ASSERT_TRUE(shows(0, "this server hears 1 gateways, and one that waits hears 6"))
      << server_shown(0);
  EXPECT_NE(shop_->rest(0).get("/api/v1/health").body.find("degraded"), std::string::npos);
  expect_it_stays(0);
  EXPECT_NE(trail(0).find("server.stay"), std::string::npos) << trail(0);
}

/// The most that a forger reaches: one hand-over while no machine is there, and none back.
TEST_F(SilentShop, AHandOverThatHelpedNothingIsTheLastUntilAPersonActs) {
  begin_with_gateway();
  shop_->gateway().kill();
  {
    const auto forger = forge_at(1, 1);
    ASSERT_TRUE(shop_->wait_active(1, seconds(60))) << shop_->log(0);
  }
  ASSERT_TRUE(eventually([&] { return shop_->role(0) == "standby"; })) << shop_->log(0);
  const auto forger = forge_at(0, 1);
  ASSERT_TRUE(shows(1, "a person decides (dnc server drain)")) << server_shown(1) << shop_->log(1);
  expect_it_stays(1);
  const auto drained = shop_->rest(1).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(drained.status, 202) << drained.body;
  EXPECT_TRUE(shop_->wait_active(0)) << shop_->log(0);
}

}  // namespace
}  // namespace dripline::integration
