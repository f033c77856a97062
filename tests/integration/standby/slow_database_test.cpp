// A line to the database that is slow, and filled by what a programmer sends: the servers stay what
// they are, and the machine's records do not wait for a whole program.
#include <atomic>
#include <random>
#include <thread>

#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;

class SlowDatabase : public TwoServersTest {
 protected:
  static std::string text_of(std::size_t bytes) {
    std::mt19937 random(7);
    std::string text = "O0300\n";
    while (text.size() < bytes)
      text += fmt::format("G1 X{}.{:04} Z-0.{:04} F800\n", random() % 9, random() % 10000,
                          random() % 10000);
    return text + "M30\n";
  }
  std::string term() const {
    return connect().text("SELECT CAST(term AS text) FROM store_holder").value_or("");
  }
};

/// Some ten seconds of the line in one piece: longer than the lease.
TEST_F(SlowDatabase, APushCostsTheActiveServerNotItsPlace) {
  begin({"--takeover-s", "6"});
  const auto before = term();
  constexpr std::uint64_t kBytesPerSecond = 64 << 10;
  for (auto& cable : cables_) cable->set_rate(kBytesPerSecond);
  std::atomic<bool> is_pushed = false;
  std::jthread pushing([&] {
    shop_->push(0, "O0300", text_of(3 << 19));
    is_pushed = true;
  });
  bool is_kept = true;
  while (!is_pushed) {
    auto database = connect();
    is_kept = is_kept && database.integer(
                             "SELECT count(*) FROM store_holder WHERE until <= "
                             "clock_timestamp()") == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_TRUE(is_kept) << "the lease ran out meanwhile";
  EXPECT_EQ(shop_->role(0), "active") << shop_->log(0);
  EXPECT_EQ(shop_->role(1), "standby") << shop_->log(1);
  EXPECT_EQ(term(), before);
  EXPECT_EQ(shop_->log(1).find("taking over"), std::string::npos) << shop_->log(1);
}

/// As of a database that hangs in the middle of a transaction of an active server that is gone.
TEST_F(SlowDatabase, AStandbyThatCannotTakeThePlaceYetWaitsAndSaysSo) {
  begin();
  auto person = connect();
  ASSERT_TRUE(person.execute("SET application_name = 'psql'"));
  shop_->server(0).kill();
  ASSERT_TRUE(person.execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR UPDATE"));
  EXPECT_TRUE(eventually([&] {
    return shop_->rest(1).get("/api/v1/health").body.find("tried to take over and could not") !=
           std::string::npos;
  })) << shop_->log(1);
  EXPECT_EQ(shop_->role(1), "standby");
  EXPECT_NE(shop_->log(1).find("(psql)"), std::string::npos) << shop_->log(1);
  ASSERT_TRUE(person.execute("COMMIT"));
  EXPECT_TRUE(shop_->wait_active(1)) << shop_->log(1);
}

}  // namespace
}  // namespace dripline::integration
