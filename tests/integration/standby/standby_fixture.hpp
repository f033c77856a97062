#pragma once

#include <gtest/gtest.h>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/postgresql/database.hpp"
#include "tests/integration/standby/two_servers.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/postgresql/database_cable.hpp"
#include "tests/support/postgresql/test_database.hpp"

namespace dripline::integration {

/// Two servers of one library, `a` that is active and `b` that stands by, each with a cable to the
/// database that can be pulled.
class TwoServersTest : public testing::Test {
 protected:
  void SetUp() override {
    database_ = test::TestDatabase::make_empty();
    if (database_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
  }
  /// The sessions of each server have its name, for the witness in the database.
  std::string store(char server) {
    auto& cable = cables_[server == 'a' ? 0 : 1];
    cable = std::make_unique<test::DatabaseCable>(database_->url());
    return cable->url() + "&options=-c%20dripline.server%3D" + server;
  }
  void begin(const std::vector<std::string>& arguments = {}) {
    shop_.emplace(TwoServers::Options{
        .stores = {store('a'), store('b')}, .speed = "10x", .arguments = arguments});
    start_both();
  }
  void start_both() {
    shop_->start(0);
    ASSERT_TRUE(shop_->wait_active(0)) << shop_->log(0);
    shop_->share_keys();
    shop_->start(1);
    ASSERT_EQ(shop_->role(1), "standby") << shop_->log(1);
    ASSERT_TRUE(shop_->wait_for_standby());
  }
  storage::postgresql::Database connect() const {
    auto database = storage::postgresql::Database::connect({.url = database_->url()});
    EXPECT_TRUE(database) << database.error().what;
    return *std::move(database);
  }
  void expect_whole_trail(int server) const {
    const auto verified =
        shop_->rest(server).post("/api/v1/audit/verification", nlohmann::json::object());
    ASSERT_EQ(verified.status, 200) << verified.body;
    EXPECT_TRUE(verified.json()["verification"]["fault"].is_null()) << verified.body;
  }
  nlohmann::json run(int server, const std::string& id) const {
    auto found = shop_->rest(server).get("/api/v1/runs/" + id).json();
    return found.is_object() ? found : nlohmann::json::object();
  }

  std::unique_ptr<test::TestDatabase> database_;
  std::array<std::unique_ptr<test::DatabaseCable>, 2> cables_;  ///< of each server
  std::optional<TwoServers> shop_;
};

}  // namespace dripline::integration
