// A server that waits for another one's library: what it says, and which folders may not wait.
#include <netinet/in.h>
#include <sys/socket.h>
#include <fstream>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

class WaitingServer : public TwoServersTest {};

TEST_F(WaitingServer, TheStandbySaysWhatItIsAndWhoIsActive) {
  begin();
  const auto health = shop_->rest(1).get("/api/v1/health");
  EXPECT_EQ(health.status, 200);
  EXPECT_EQ(health.json().value("role", ""), "standby") << health.body;
  const auto ready = shop_->rest(1).get("/api/v1/ready");
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(ready.json().value("ready", true), false) << ready.body;
  EXPECT_EQ(shop_->rest(0).get("/api/v1/ready").json().value("role", ""), "active");
  const auto refused = shop_->rest(1).get("/api/v1/machines");
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.body.find(shop_->rest(0).url()), std::string::npos) << refused.body;
  EXPECT_NE(shop_->rest(1).get("/api/v1/metrics").body.find("\ndripline_server_active 0\n"),
            std::string::npos);
  const auto metrics = shop_->rest(0).get("/api/v1/metrics").body;
  EXPECT_NE(metrics.find("\ndripline_server_active 1\n"), std::string::npos);
  EXPECT_NE(metrics.find("\ndripline_server_standbys 1\n"), std::string::npos);
}

TEST_F(WaitingServer, ShowsABrowserThePageThatNamesTheActiveOne) {
  begin();
  const auto page = shop_->rest(1).get("/", {{"Accept", "text/html,application/xhtml+xml,*/*"},
                                             {"Accept-Language", "de-AT,de;q=0.9,en;q=0.5"}});
  EXPECT_EQ(page.status, 503);
  EXPECT_NE(page.body.find("Bereitschaft"), std::string::npos) << page.body;
  EXPECT_NE(page.body.find("<a href=\"" + shop_->rest(0).url() + "/\">"), std::string::npos)
      << page.body;
  EXPECT_NE(page.headers.find("Content-Security-Policy"), page.headers.end());
  const auto program = shop_->rest(1).get("/api/v1/programs", {{"Accept", "text/html"}});
  EXPECT_EQ(program.json()["error"].value("code", ""), "busy") << program.body;
}

/// As scripts and people use it, before and after a takeover.
TEST_F(WaitingServer, IsAskedByNobodyWhoNamesBothServers) {
  begin();
  const auto dnc = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--server",
                                         shop_->rest(1).url() + "," + shop_->rest(0).url(),
                                         "--token-file", shop_->state(0) / "token"});
    return test_support::run_to_end(arguments, shop_->folder() / "dnc.out");
  };
  const auto program = shop_->folder() / "O1.nc";
  std::ofstream(program) << "O1\nM30\n";
  const auto pushed = dnc({"program", "push", program, "--name", "O1"});
  EXPECT_EQ(pushed.status, 0) << pushed.output;
  shop_->server(0).kill();
  ASSERT_TRUE(shop_->wait_active(1));
  const auto listed = dnc({"program", "list"});
  EXPECT_EQ(listed.status, 0) << listed.output;
  EXPECT_NE(listed.output.find("O1"), std::string::npos) << listed.output;
  shop_->server(1).kill();
  const auto refused = dnc({"program", "list"});
  EXPECT_EQ(refused.status, 3) << refused.output;
  for (int server : {0, 1})
    EXPECT_NE(refused.output.find(shop_->rest(server).url()), std::string::npos) << refused.output;
}

/// It could take over only where the other one has ended, and not where that one hangs.
TEST_F(WaitingServer, IsRefusedWithThePortOfTheActiveOneOnThisComputer) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  ASSERT_TRUE(shop_->wait_active(0));
  shop_->share_keys();
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", shop_->state(1), "--store", store('b'), "--standby", "yes",
       "--http", "127.0.0.1:0", "--dds-domain", std::to_string(shop_->domain()), "--dds-tag",
       shop_->tag(), "--dds-port", std::to_string(shop_->dds_port(0))},
      shop_->folder() / "same.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find(fmt::format("UDP port {} is in use", shop_->dds_port(0))),
            std::string::npos)
      << refused.output;
  EXPECT_NE(refused.output.find("--dds-port each, 16 apart"), std::string::npos) << refused.output;
  EXPECT_EQ(shop_->role(0), "active");
}

/// The place is not taken without gateways, and nothing is handed over to a server that cannot.
TEST_F(WaitingServer, WaitsForAPortThatAnotherProgramHasTakenMeanwhile) {
  begin();
  const auto term = [&] {
    return connect().text("SELECT CAST(term AS text) FROM store_holder").value_or("");
  };
  const auto before = term();
  std::optional<Descriptor> other(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port =
      htons(static_cast<std::uint16_t>(shop_->dds_port(1) + 1));  // the first is its own
  ASSERT_EQ(::bind(other->get(), reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  const auto standbys = [&] {
    return shop_->rest(0).get("/api/v1/server").json()["sharing"]["standbys"].size();
  };
  ASSERT_TRUE(test_support::eventually([&] { return standbys() == 0; })) << shop_->log(1);
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  shop_->server(0).kill();
  ASSERT_TRUE(test_support::eventually([&] {
    auto database = connect();
    return database.integer(
               "SELECT count(*) FROM store_holder WHERE until < now() - interval "
               "'2 seconds'") == 1;
  }));
  EXPECT_EQ(shop_->role(1), "standby");
  EXPECT_EQ(term(), before);
  const auto health = shop_->rest(1).get("/api/v1/health");
  EXPECT_NE(health.body.find("a UDP port that this server needs"), std::string::npos)
      << health.body;
  EXPECT_NE(shop_->log(1).find(fmt::format("cannot take over: DDS domain {}: UDP port {} is in use",
                                           shop_->domain(), shop_->dds_port(1) + 1)),
            std::string::npos)
      << shop_->log(1);
  other.reset();
  EXPECT_TRUE(shop_->wait_active(1)) << shop_->log(1);
}

/// Found at its start and not at the moment of need; the machines do not wait for readers.
TEST_F(WaitingServer, SaysThatItWouldLackItsMTConnectAgentAndTakesOverWithoutIt) {
  std::optional<Descriptor> other(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(other->get(), reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  ASSERT_EQ(::listen(other->get(), 1), 0);
  socklen_t size = sizeof place;
  ASSERT_EQ(::getsockname(other->get(), reinterpret_cast<sockaddr*>(&place), &size), 0);
  const std::string address = fmt::format("127.0.0.1:{}", ntohs(place.sin_port));
  begin({"--mtconnect=" + address});  // on one computer one of two at most has it
  EXPECT_EQ(shop_->role(0), "active");
  const auto active = [&] { return shop_->rest(0).get("/api/v1/server").body; };
  EXPECT_TRUE(test_support::eventually([&] {
    return active().find("without its MTConnect agent: " + address + " is in use") !=
           std::string::npos;
  })) << active();
  EXPECT_NE(shop_->log(1).find("would take over without its MTConnect agent: " + address),
            std::string::npos)
      << shop_->log(1);
  const auto health = shop_->rest(1).get("/api/v1/health");
  EXPECT_NE(health.body.find("\"mtconnect\""), std::string::npos) << health.body;
  EXPECT_NE(shop_->rest(1).get("/api/v1/metrics").body.find("\ndripline_server_standby_ok 0\n"),
            std::string::npos);
  shop_->server(0).kill();
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  const auto degraded = [&] { return shop_->rest(1).get("/api/v1/health").body; };
  EXPECT_NE(degraded().find("the MTConnect agent cannot listen"), std::string::npos) << degraded();
  other.reset();
  EXPECT_TRUE(test_support::eventually([&] {
    return degraded().find("the MTConnect agent cannot listen") == std::string::npos;
  })) << degraded();
  const test_support::RestClient agent("http://" + address, "");
  EXPECT_EQ(agent.get("/probe").status, 200);
}

TEST_F(WaitingServer, AFolderWithoutTheKeysIsRefused) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", shop_->state(1), "--store", store('b'), "--standby", "yes",
       "--http", "127.0.0.1:0", "--dds-domain", std::to_string(shop_->domain())},
      shop_->folder() / "refused.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("signing.key, token and database.id"), std::string::npos)
      << refused.output;
}

TEST_F(WaitingServer, AFolderWithAnotherTokenIsRefused) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  shop_->share_keys();
  std::ofstream(shop_->state(1) / "token") << std::string(64, 'a') << "\n";
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", shop_->state(1), "--store", store('b'), "--standby", "yes",
       "--http", "127.0.0.1:0", "--dds-domain", std::to_string(shop_->domain())},
      shop_->folder() / "refused.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("is not the token that the active server has"), std::string::npos)
      << refused.output;
}

TEST_F(WaitingServer, ASqliteFileHasNoStandby) {
  const test_support::TemporaryFolder folder;
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", folder.path() / "s", "--standby", "yes"},
      folder.path() / "out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("standby: servers share a PostgreSQL database"), std::string::npos)
      << refused.output;
}

/// Gateways look for their server in the active one's domain.
TEST_F(WaitingServer, IsRefusedWithOtherDdsSettings) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  ASSERT_TRUE(shop_->wait_active(0));
  shop_->share_keys();
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", shop_->state(1), "--store", store('b'), "--standby", "yes",
       "--http", "127.0.0.1:0", "--dds-domain", std::to_string(shop_->domain()), "--dds-tag",
       "another", "--dds-port", std::to_string(shop_->dds_port(1))},
      shop_->folder() / "other.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find(
                fmt::format("dds-tag is another, and {} at the active server", shop_->tag())),
            std::string::npos)
      << refused.output;
  EXPECT_EQ(shop_->role(0), "active");
}

/// A takeover would let other programs run, and a shop's folders would not be read any more.
TEST_F(WaitingServer, SaysThatItsSettingsAreNotThoseOfTheActiveOne) {
  const test_support::TemporaryFolder folder;
  const std::string policy = folder.path() / "policy.toml";
  std::ofstream(policy) << "runs = \"release\"\n";
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')},
                                    .speed = "10x",
                                    .second_arguments = {"--policy", policy}});
  start_both();
  const auto active = [&] { return shop_->rest(0).get("/api/v1/server").body; };
  EXPECT_TRUE(test_support::eventually([&] {
    return active().find("its settings differ: policy is sha256 ") != std::string::npos;
  })) << active();
  const auto health = shop_->rest(1).get("/api/v1/health");
  EXPECT_EQ(health.json().value("status", ""), "degraded") << health.body;
  EXPECT_NE(health.body.find("\"settings\""), std::string::npos) << health.body;
  EXPECT_EQ(health.body.find("sha256"), std::string::npos) << health.body;
  EXPECT_NE(shop_->log(1).find("policy is sha256 "), std::string::npos) << shop_->log(1);
}

/// A dead server would be noticed at another time than people think.
TEST_F(WaitingServer, SaysThatItsTakeoverTimeIsNotThatOfTheActiveOne) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')},
                                    .second_arguments = {"--takeover-s", "5"}});
  start_both();
  const std::string difference = "takeover-s is 5, and 3 at the active server";
  EXPECT_TRUE(test_support::eventually([&] {
    return shop_->rest(0).get("/api/v1/server").body.find(difference) != std::string::npos;
  })) << shop_->log(0);
  EXPECT_NE(shop_->log(1).find(difference), std::string::npos) << shop_->log(1);
  const auto health = shop_->rest(1).get("/api/v1/health");
  EXPECT_EQ(health.json().value("status", ""), "degraded") << health.body;
}

/// Nobody can have the place then: the one that waits says which row is missing.
TEST_F(WaitingServer, NamesTheRowOfThePlaceThatIsGone) {
  begin();
  ASSERT_TRUE(connect().execute("DELETE FROM store_holder"));
  EXPECT_TRUE(test_support::eventually([&] {
    return shop_->log(1).find("has lost the row of its place (table store_holder)") !=
           std::string::npos;
  })) << shop_->log(1);
}

}  // namespace
}  // namespace dripline::integration
