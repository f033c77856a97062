#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class SetupRoutes : public ApiTest {
 protected:
  SetupRoutes() {
    machines::MachineView view;
    view.machine.name = "lathe-1";
    view.machine.control = "centurion";
    machines_.views.push_back(view);
  }
  api::Response put(const std::string& target, const std::string& text) {
    return call("PUT", "/api/v1/machines/" + target, {.body = text, .headers = {}});
  }
};

TEST_F(SetupRoutes, KeepATextAndGiveItBack) {
  const std::string text = "# Drehlänge\n[[tool]]\nnumber = 1\n";
  const auto saved = put("lathe-1/setup?comment=new%20insert", text);
  ASSERT_EQ(saved.status, 201) << body(saved);
  EXPECT_EQ(json(saved).at("revision"), 1);
  EXPECT_EQ(json(saved).at("comment"), "new insert");
  EXPECT_EQ(json(saved).at("author"), "admin");
  EXPECT_EQ(put("lathe-1/setup", text).status, 200);
  EXPECT_EQ(json(get("/api/v1/machines/lathe-1/setup")).at("text"), text);
  ASSERT_EQ(put("lathe-1/setup", "a = 2").status, 201);
  EXPECT_EQ(json(get("/api/v1/machines/lathe-1/setup?revision=1")).at("text"), text);
  const auto list = json(get("/api/v1/machines/lathe-1/setups?limit=1")).at("setups");
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].at("revision"), 2);
  EXPECT_FALSE(list[0].contains("text"));
}

TEST_F(SetupRoutes, RefuseWhatTheControlWouldNotTake) {
  const auto refused = put("lathe-1/setup", "wrong = 1");
  EXPECT_EQ(refused.status, 400);
  EXPECT_NE(body(refused).find("wrong"), std::string::npos);
  EXPECT_EQ(put("lathe-1/setup?control=tnc155", "a = 1").status, 409) << "it is a centurion";
  EXPECT_EQ(put("lathe-1/setup?color=red", "a = 1").status, 400);
  EXPECT_EQ(get("/api/v1/machines/lathe-1/setup").status, 404);
}

TEST_F(SetupRoutes, DoNotPutATextOverANewerOne) {
  ASSERT_EQ(put("lathe-1/setup?base=0", "a = 1").status, 201);
  ASSERT_EQ(put("lathe-1/setup?base=1", "a = 2").status, 201);
  const auto late = put("lathe-1/setup?base=1", "a = 3");
  EXPECT_EQ(late.status, 409) << body(late);
  EXPECT_NE(body(late).find("made from 1, and 2 is the newest"), std::string::npos) << body(late);
  EXPECT_EQ(json(get("/api/v1/machines/lathe-1/setup")).at("text"), "a = 2");
  EXPECT_EQ(put("lathe-1/setup?base=1", "a = 2").status, 200) << "asked again, not lost";
  EXPECT_EQ(put("lathe-1/setup?base=two", "a = 3").status, 400);
}

TEST_F(SetupRoutes, AskForTheControlOfAMachineNeverSeen) {
  EXPECT_EQ(put("mill-9/setup", "a = 1").status, 404);
  EXPECT_EQ(put("mill-9/setup?control=tnc155", "a = 1").status, 201);
  EXPECT_EQ(json(get("/api/v1/machines/mill-9/setups")).at("setups").size(), 1u);
}

TEST_F(SetupRoutes, NeedTheToken) {
  EXPECT_EQ(call("PUT", "/api/v1/machines/lathe-1/setup",
                 {.body = "a = 1", .headers = {}, .token = "other"})
                .status,
            401);
}

TEST_F(SetupRoutes, StateWhichOneIsInAControlAtTheEndOfALine) {
  const std::string loaded = "/api/v1/machines/lathe-1/setup/loaded";
  ASSERT_EQ(put("lathe-1/setup", "a = 1").status, 201);
  EXPECT_EQ(get(loaded).status, 404) << "never stated";
  const auto stated = put("lathe-1/setup/loaded", R"({"revision": 1})");
  ASSERT_EQ(stated.status, 200) << body(stated);
  EXPECT_EQ(json(stated).at("revision"), 1);
  EXPECT_EQ(json(get(loaded)).at("who"), "admin");
  EXPECT_EQ(put("lathe-1/setup/loaded", R"({"revision": 2})").status, 404);
  EXPECT_EQ(put("lathe-1/setup/loaded", R"({"revision": "1"})").status, 400);
  EXPECT_EQ(put("lathe-1/setup/loaded", R"({"version": 1})").status, 400);
  EXPECT_EQ(put("lathe-1/setup/loaded", "").status, 400);
  EXPECT_EQ(json(get(loaded)).at("revision"), 1);
  EXPECT_EQ(put("lathe-1/setup/loaded", "{}").status, 200);
  EXPECT_TRUE(json(get(loaded)).at("revision").is_null());
  EXPECT_EQ(put("mill-9/setup/loaded", "{}").status, 404) << "no such machine";
}

TEST_F(SetupRoutes, AreNotAskedWhatAGatewayGetsWithEachStart) {
  machines_.views[0].machine.gateway_version = "1.0";
  ASSERT_EQ(put("lathe-1/setup", "a = 1").status, 201);
  const auto refused = put("lathe-1/setup/loaded", R"({"revision": 1})");
  EXPECT_EQ(refused.status, 409) << body(refused);
  EXPECT_NE(body(refused).find("with each start"), std::string::npos) << body(refused);
  machines_.views[0].status.emplace().serial_line.emplace();
  EXPECT_EQ(put("lathe-1/setup/loaded", R"({"revision": 1})").status, 200) << "its line";
}

}  // namespace
}  // namespace dripline::server_test
