#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class GatewayRoutes : public ApiTest {
 protected:
  GatewayRoutes() { (void)stored_run(0); }
  const std::string path_ = "/api/v1/machines/lathe-1/confirm-gateway";
};

TEST_F(GatewayRoutes, ConfirmWithAnEntryBeforeAndAfter) {
  EXPECT_EQ(call("POST", path_).status, 204);
  EXPECT_EQ(machines_.confirmed, std::vector<std::string>{"lathe-1"});
  const auto entries = json(get("/api/v1/audit"))["entries"];
  for (const int i : {0, 1}) {
    EXPECT_EQ(entries[i]["action"], "machine.confirm_gateway");
    EXPECT_EQ(entries[i]["subject"], "lathe-1");
  }
  EXPECT_EQ(entries[0]["detail"], "gateway 0.1.0");
}

TEST_F(GatewayRoutes, RefuseWhereNoneWaits) {
  machines_.refusal = Error{Errc::Conflict, "machine 'lathe-1': no gateway waits to be confirmed"};
  expect_error(call("POST", path_), 409, "conflict", "no gateway waits");
  EXPECT_EQ(call("POST", "/api/v1/machines/mill-9/confirm-gateway").status, 404);
  EXPECT_EQ(machines_.confirmed.size(), 1U);
}

}  // namespace
}  // namespace dripline::server_test
