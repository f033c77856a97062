#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class MachineListRoutes : public ApiTest {
 protected:
  void add(int number) {
    machines::MachineView view;
    view.machine.name = fmt::format("m{:04}", number);
    machines_.views.push_back(view);
  }
  std::vector<std::string> names(const std::string& query) {
    std::vector<std::string> all;
    const auto answer = json(get("/api/v1/machines" + query));
    for (const auto& machine : answer["machines"]) all.push_back(machine["name"]);
    return all;
  }
};

TEST_F(MachineListRoutes, ListPageByPage) {
  machines_.views.clear();
  for (int i = 250; i > 0; --i) add(i);
  EXPECT_EQ(names("").size(), 100U);
  EXPECT_EQ(names("?limit=2"), (std::vector<std::string>{"m0001", "m0002"}));
  EXPECT_EQ(names("?limit=2&after=m0002"), (std::vector<std::string>{"m0003", "m0004"}));
  EXPECT_EQ(names("?limit=1000").size(), 250U);
  EXPECT_TRUE(names("?after=m0250").empty());
  EXPECT_EQ(get("/api/v1/machines?limit=1001").status, 413);
}

TEST_F(MachineListRoutes, RemoveAMachine) {
  EXPECT_EQ(call("DELETE", "/api/v1/machines/lathe-1").status, 204);
  EXPECT_EQ(machines_.removed, std::vector<std::string>{"lathe-1"});
  machines_.refusal = Error{Errc::Busy, "machine 'lathe-1' is connected: stop its gateway first"};
  expect_error(call("DELETE", "/api/v1/machines/lathe-1"), 409, "busy", "is connected");
}

}  // namespace
}  // namespace dripline::server_test
