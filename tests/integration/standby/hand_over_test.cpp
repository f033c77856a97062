// An active server that ends, or is told to, hands its library over at once, and only to a server
// that takes it.
#include <csignal>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

class HandOver : public TwoServersTest {};

/// Sessions, tokens, webhooks and the rest come from the database.
TEST_F(HandOver, AnOrderlyEndHandsOverAtOnceWithEverythingInTheDatabase) {
  begin();
  const auto token = shop_->rest(0).post("/api/v1/users/admin/tokens", {{"name", "robot"}});
  ASSERT_EQ(token.status, 201) << token.body;
  const std::string secret = token.json().value("secret", token.json().value("token", ""));
  shop_->server(0).signal(SIGTERM);
  ASSERT_TRUE(shop_->wait_active(1));
  EXPECT_NE(shop_->log(0).find("which no server has had"), std::string::npos) << shop_->log(0);
  EXPECT_NE(shop_->log(1).find(": it has given the library back"), std::string::npos)
      << "without waiting for the end of a lease: " << shop_->log(1);
  EXPECT_EQ(shop_->server(0).wait(), 0);
  const test_support::RestClient robot(shop_->rest(1).url(), secret);
  EXPECT_EQ(robot.get("/api/v1/server").status, 200);
  expect_whole_trail(1);
}

TEST_F(HandOver, ADrainAtTheCommandLineHandsOverAndTheDrainedOneStandsBy) {
  begin();
  const auto dnc = [&](int server, const std::string& verb) {
    return test_support::run_to_end(
        {program_path("dnc"), "--state", shop_->state(server), "server", verb},
        shop_->folder() / "dnc.out");
  };
  const auto shown = dnc(0, "status");
  EXPECT_EQ(shown.status, 0) << shown.output;
  EXPECT_NE(shown.output.find(", standby: dncd "), std::string::npos) << shown.output;
  const auto refused = dnc(1, "drain");
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.output.find("this server stands by"), std::string::npos) << refused.output;
  const auto drained = dnc(0, "drain");
  EXPECT_EQ(drained.status, 0) << drained.output;
  EXPECT_NE(drained.output.find("handed over to dncd "), std::string::npos) << drained.output;
  ASSERT_TRUE(shop_->wait_active(1));
  EXPECT_TRUE(shop_->wait_for_standby());
  EXPECT_EQ(shop_->role(0), "standby");
  EXPECT_TRUE(shop_->server(0).is_running()) << "the same process";
  expect_whole_trail(1);
}

TEST_F(HandOver, WithoutAStandbyNothingIsHandedOver) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("no server waits"), std::string::npos) << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
}

TEST_F(HandOver, NothingIsHandedOverToAStandbyThatDoesNotAnswer) {
  begin();
  shop_->server(1).signal(SIGSTOP);
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  const bool is_refused = refused.body.find("has not looked at it") != std::string::npos ||
                          refused.body.find("no server waits") != std::string::npos;  // by then
  EXPECT_TRUE(is_refused) << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
  shop_->server(1).signal(SIGCONT);
  ASSERT_TRUE(shop_->wait_for_standby());
  const auto drained = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(drained.status, 202) << drained.body;
  ASSERT_TRUE(shop_->wait_active(1));
}

}  // namespace
}  // namespace dripline::integration
