// The database is lost, and an older copy of it comes in its place: the drill of
// deploy/docs/operations.md, while a machine runs.
#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;

class RestoredDatabase : public TwoServersTest {
 protected:
  std::string name() const {
    const std::string& url = database_->url();
    const auto begin = url.find("@/") + 2;
    return url.substr(begin, url.find('?') - begin);
  }
  /// At another database of the same PostgreSQL.
  void at_postgres(const std::string& sql) const {
    std::string url = database_->url();
    url.replace(url.find("@/") + 2, name().size(), "postgres");
    auto database = storage::postgresql::Database::connect({.url = url});
    ASSERT_TRUE(database) << database.error().what;
    const auto done = database->execute(sql);
    ASSERT_TRUE(done) << sql << ": " << done.error().what;
  }
  std::int64_t number(const std::string& sql) const {
    auto database = connect();
    return database.integer(sql).value_or(-1);
  }
  void kill_both() {
    for (const int server : {0, 1}) shop_->server(server).kill();
  }
};

std::string program_of(int lines) {
  std::string text = "O0300\nG20 G93 G98\nG0 X2 Z0\nPOPEN P0\n";
  for (int line = 1; line <= lines; ++line) {
    text += fmt::format("P1={}\n", line);
    for (int i = 0; i < 50; ++i) text += fmt::format("G1 X2.00{} Z-0.0{:02} F800\n", i % 2, i % 31);
    text += "DPRNT [LINE #1[60]]\n";
  }
  return text + "PCLOS\nM30\n";
}

TEST_F(RestoredDatabase, IsWorkedWithByTheSameGatewayInAHigherTerm) {
  begin();
  shop_->start_gateway();
  ASSERT_TRUE(shop_->wait_connected(0)) << shop_->gateway_log();
  shop_->push(0, "O0300", program_of(8000));
  const auto started =
      shop_->rest(0).post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
  ASSERT_EQ(started.status, 201) << started.body;
  const std::string id = started.json().value("id", "none");
  const auto wait_records = [&](std::int64_t least) {
    return eventually([&] { return number("SELECT count(*) FROM record") >= least; });
  };
  ASSERT_TRUE(wait_records(5));
  kill_both();
  const std::string copy = name() + "_copy";
  ASSERT_NO_FATAL_FAILURE(at_postgres(fmt::format(
      "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = '{}'", name())));
  ASSERT_TRUE(eventually([&] {
    return number(fmt::format("SELECT count(*) FROM pg_stat_activity WHERE datname = '{}' AND pid "
                              "<> pg_backend_pid()",
                              name())) == 0;
  }));
  ASSERT_NO_FATAL_FAILURE(at_postgres(fmt::format("CREATE DATABASE {} TEMPLATE {}", copy, name())));
  const auto copied = number("SELECT count(*) FROM record");
  shop_->start(0);
  ASSERT_TRUE(shop_->wait_active(0) && shop_->wait_connected(0)) << shop_->log(0);
  ASSERT_TRUE(wait_records(copied + 10)) << "which will be lost";
  const auto before = number("SELECT term FROM store_holder");
  shop_->server(0).kill();
  ASSERT_NO_FATAL_FAILURE(at_postgres(fmt::format("DROP DATABASE {} WITH (FORCE)", name())));
  ASSERT_NO_FATAL_FAILURE(at_postgres(fmt::format("ALTER DATABASE {} RENAME TO {}", copy, name())));
  shop_->start(0);
  ASSERT_TRUE(shop_->wait_active(0)) << shop_->log(0);
  EXPECT_TRUE(shop_->wait_connected(0)) << "without a restart of the gateway";
  EXPECT_GT(number("SELECT term FROM store_holder"), before);
  shop_->start(1);
  EXPECT_EQ(shop_->role(1), "standby") << shop_->log(1);
  EXPECT_TRUE(wait_records(copied + 5)) << "the run that the copy has continues";
  EXPECT_EQ(run(0, id).value("state", ""), "active") << run(0, id).dump();
  expect_whole_trail(0);
}

}  // namespace
}  // namespace dripline::integration
