#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

using test_support::eventually;

class BackupRoutes : public ApiTest {
 protected:
  Json ended() {
    Json state;
    EXPECT_TRUE(eventually([&] {
      state = json(get("/api/v1/backups"));
      return state["work"].is_null() && !state["last"].is_null();
    }));
    return state;
  }
};

TEST_F(BackupRoutes, SayThatNoneAreMade) {
  expect_error(get("/api/v1/backups"), 404, "not_found", "--backups");
  expect_error(call("POST", "/api/v1/backups"), 404, "not_found", "--backups");
}

TEST_F(BackupRoutes, MakeVerifyAndRemove) {
  set_up_backups();
  EXPECT_EQ(json(get("/api/v1/backups"))["backups"], Json::array());
  EXPECT_EQ(call("POST", "/api/v1/backups").status, 202);
  const Json made = ended();
  ASSERT_EQ(made["backups"].size(), 1u) << made;
  EXPECT_EQ(made["last"]["error"], "");
  const std::string id = made["backups"][0]["id"];
  EXPECT_TRUE(made["backups"][0]["verified"].is_null());
  EXPECT_EQ(call("POST", "/api/v1/backups/" + id + "/verify").status, 202);
  EXPECT_TRUE(eventually(
      [&] { return json(get("/api/v1/backups"))["backups"][0]["verified"].is_string(); }));
  expect_error(call("DELETE", "/api/v1/backups/" + id), 409, "conflict", "only one");
  expect_error(call("DELETE", "/api/v1/backups/20000101T000000Z"), 404, "not_found", "20000101");
}

}  // namespace
}  // namespace dripline::server_test
