// A job of several parts while servers are killed: the queue is as it was, each part is one run,
// and none is started twice.
#include <random>
#include <thread>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using test_support::eventually;

class TakenJobs : public TwoServersTest {
 protected:
  json jobs(int server, const std::string& state) const {
    auto shown = shop_->rest(server).get("/api/v1/machines/lathe-1/jobs?state=" + state).json();
    return shown.is_object() ? shown.value("jobs", json::array()) : json::array();
  }
  /// Its server may be killed before it answers, or afterwards.
  void start_job(int server) const {
    static_cast<void>(
        shop_->rest(server).post("/api/v1/machines/lathe-1/start-job", json::object()));
  }
  std::int64_t count(const std::string& what) const {
    auto database = connect();
    return database.integer("SELECT count(*) FROM " + what).value_or(-1);
  }
};

constexpr int kParts = 4;

TEST_F(TakenJobs, AJobOfPartsIsMadeOnceHoweverOftenItsServerIsKilled) {
  begin();
  shop_->start_gateway();
  ASSERT_TRUE(shop_->wait_connected(0)) << shop_->gateway_log();
  shop_->push(0, "O0300", "G00 X1.\nG04 P3\nM30\n");
  const auto queued = shop_->rest(0).post("/api/v1/machines/lathe-1/jobs",
                                          {{"program", "O0300"}, {"quantity", kParts}});
  ASSERT_EQ(queued.status, 201) << queued.body;
  std::mt19937 random(7);
  int active = 0, kills = 0;
  const auto is_over = [&] { return !jobs(active, "closed").empty(); };
  const bool is_done = eventually(
      [&] {
        if (is_over()) return true;
        start_job(active);
        if (kills >= 3) return false;
        std::this_thread::sleep_for(milliseconds(random() % 300));
        shop_->server(active).kill();
        ++kills;
        const int other = 1 - active;
        EXPECT_TRUE(shop_->wait_active(other) && shop_->wait_connected(other)) << shop_->log(other);
        shop_->start(active);
        EXPECT_TRUE(shop_->wait_for_standby()) << shop_->log(active);
        active = other;
        return false;
      },
      std::chrono::minutes(3));
  ASSERT_TRUE(is_done) << jobs(active, "open").dump() << shop_->log(active);
  EXPECT_EQ(kills, 3);
  const auto closed = jobs(active, "closed");
  ASSERT_EQ(closed.size(), 1U) << closed.dump();
  EXPECT_EQ(closed[0].value("state", ""), "done") << closed.dump();
  EXPECT_EQ(closed[0].value("completed", 0), kParts) << closed.dump();
  EXPECT_EQ(count("run WHERE state = 'completed' AND job IS NOT NULL"), kParts);
  EXPECT_EQ(count("run WHERE state IN ('active', 'ordered')"), 0);
  expect_whole_trail(active);
}

}  // namespace
}  // namespace dripline::integration
