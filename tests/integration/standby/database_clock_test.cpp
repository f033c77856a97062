// The clock of the database is set: who works stays the active server, who is gone is followed, and
// who was frozen meanwhile takes nothing before it has looked for long enough.
#include <thread>

#include "tests/integration/standby/standby_fixture.hpp"
#include "tests/support/postgresql/database_clock.hpp"

namespace dripline::integration {
namespace {

using namespace std::chrono_literals;

class ClockOfTheDatabase : public TwoServersTest {
 protected:
  void begin_with_clock() {
    clock_.emplace(database_->url());
    begin();
  }
  std::string term() const {
    return connect().text("SELECT CAST(term AS text) FROM store_holder").value_or("");
  }
  std::optional<test::DatabaseClock> clock_;
};

TEST_F(ClockOfTheDatabase, GoesBackAsTheActiveServerDiesAndTheOtherOneTakesOver) {
  begin_with_clock();
  shop_->server(0).kill();
  clock_->shift(-1h);
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  EXPECT_NE(shop_->log(1).find("its lease ran out"), std::string::npos) << shop_->log(1);
  shop_->start(0);
  EXPECT_EQ(shop_->role(0), "standby");
  ASSERT_TRUE(shop_->wait_for_standby());
  EXPECT_EQ(shop_->rest(1).post("/api/v1/server/drain", nlohmann::json::object()).status, 202);
  EXPECT_TRUE(shop_->wait_active(0)) << shop_->log(0);
}

TEST_F(ClockOfTheDatabase, IsSetWhileTheActiveServerWorksAndItStaysThat) {
  begin_with_clock();
  const auto before = term();
  for (const auto by : {1h, -2h, 2h, -1h}) {
    clock_->shift(by);
    std::this_thread::sleep_for(1s);
  }
  ASSERT_TRUE(shop_->wait_for_standby());
  EXPECT_EQ(shop_->role(0), "active") << shop_->log(0);
  EXPECT_EQ(term(), before);
  EXPECT_EQ(shop_->log(1).find("taking over"), std::string::npos) << shop_->log(1);
}

TEST_F(ClockOfTheDatabase, WasSetForwardWhileTheStandbyWasFrozen) {
  begin_with_clock();
  const auto before = term();
  shop_->freeze(1);
  std::this_thread::sleep_for(4s);  // longer than a lease
  clock_->shift(1h);
  shop_->thaw(1);
  ASSERT_TRUE(shop_->wait_for_standby());
  EXPECT_EQ(shop_->role(0), "active") << shop_->log(0);
  EXPECT_EQ(term(), before);
  EXPECT_EQ(shop_->log(1).find("taking over"), std::string::npos) << shop_->log(1);
  shop_->server(0).kill();
  EXPECT_TRUE(shop_->wait_active(1)) << shop_->log(1);
}

TEST_F(ClockOfTheDatabase, GoesBackAndNothingIsHandedOverToAStandbyThatDoesNotAnswer) {
  begin_with_clock();
  shop_->freeze(1);
  clock_->shift(-1h);
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
  shop_->thaw(1);
  ASSERT_TRUE(shop_->wait_for_standby());
  EXPECT_EQ(shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object()).status, 202);
  EXPECT_TRUE(shop_->wait_active(1)) << shop_->log(1);
}

}  // namespace
}  // namespace dripline::integration
