#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

class Jog : public ApiTest {};
const std::string kJog = "/api/v1/machines/lathe-1/jog";

TEST_F(Jog, IsOneStepOnRecordBeforeAndAfterIt) {
  (void)stored_run(0);
  const auto done = post(kJog, {{"axis", "X"}, {"distance", -1.5}, {"unit", "mm"}, {"feed", 300}});
  ASSERT_EQ(done.status, 200) << done.body;
  EXPECT_EQ(machines_.jogs.back().move, "X -1.5 mm F300");
  EXPECT_EQ(json(done)["text"], "X 12.5 mm");
  EXPECT_EQ(json(done)["machine"], "lathe-1");
  EXPECT_EQ(json(done)["position"], 12.5);
  EXPECT_EQ(json(done)["reached"], true);
  const auto entries = json(get("/api/v1/audit"))["entries"];
  EXPECT_EQ(entries[0]["action"], "machine.jog");
  EXPECT_EQ(entries[0]["subject"], "lathe-1");
  EXPECT_EQ(entries[0]["detail"], "X -1.5 mm F300: X 12.5 mm");
  EXPECT_EQ(entries[1]["detail"], "X -1.5 mm F300") << "before it went out";
  EXPECT_EQ(post(kJog, {{"axis", "C"}, {"distance", 0.5}}).status, 200);
  EXPECT_EQ(machines_.jogs.back().move, "C 0.5 deg");
  EXPECT_EQ(post(kJog, {{"axis", "Z"}, {"distance", 0.01}, {"unit", "in"}}).status, 200);
  EXPECT_EQ(machines_.jogs.back().move, "Z 0.01 in");
}

TEST_F(Jog, IsHeldByItsWordAndOnRecordOnce) {
  (void)stored_run(0);
  const Json held{{"axis", "X"}, {"distance", 50}, {"unit", "mm"}, {"hold", "3f-Aa"}};
  ASSERT_EQ(post(kJog, held).status, 200);
  EXPECT_EQ(machines_.jogs.back().move, "X 50 mm hold=3f-Aa");
  const auto entries = json(get("/api/v1/audit"))["entries"].size();
  const auto kept = post(kJog + "/hold", {{"hold", "3f-Aa"}});
  ASSERT_EQ(kept.status, 200) << kept.body;
  EXPECT_EQ(json(kept)["held"], true);
  EXPECT_EQ(machines_.jogs.back().move, "keep=3f-Aa");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"].size(), entries);
  expect_error(post(kJog + "/hold", {{"hold", "a b"}}), 400, "syntax", "hold 'a b'");
  expect_error(post(kJog + "/hold", Json::object()), 400, "syntax", "hold");
  Json bad = held;
  bad["hold"] = "";
  expect_error(post(kJog, bad), 400, "syntax", "hold ''");
}

TEST_F(Jog, ThatIsNoStepGoesNowhere) {
  (void)stored_run(0);
  const auto refuse = [&](const Json& body, int status, const char* code, const char* what) {
    expect_error(post(kJog, body), status, code, what);
  };
  refuse({{"axis", "X"}, {"distance", 1}}, 400, "syntax", "unit is missing");
  refuse({{"axis", "X"}, {"distance", 0}, {"unit", "mm"}}, 400, "syntax", "distance");
  refuse({{"axis", "X"}, {"unit", "mm"}}, 400, "syntax", "distance");
  refuse({{"axis", "Q"}, {"distance", 1}, {"unit", "mm"}}, 400, "syntax", "axis 'Q'");
  refuse({{"axis", "XY"}, {"distance", 1}, {"unit", "mm"}}, 413, "limit_exceeded", "axis");
  refuse({{"axis", "C"}, {"distance", 1}, {"unit", "mm"}}, 400, "syntax", "degrees");
  refuse({{"axis", "X"}, {"distance", 1}, {"unit", "deg"}}, 400, "syntax", "'deg'");
  refuse({{"axis", "X"}, {"distance", 1e7}, {"unit", "mm"}}, 413, "limit_exceeded", "10000000");
  refuse({{"axis", "X"}, {"distance", "1"}, {"unit", "mm"}}, 400, "syntax", "distance");
  refuse({{"axis", "X"}, {"distance", 1}, {"unit", "mm"}, {"feed", 0}}, 413, "limit_exceeded",
         "feed 0");
  refuse({{"axis", "X"}, {"distance", 1}, {"unit", "mm"}, {"repeat", 2}}, 400, "syntax", "repeat");
  EXPECT_EQ(
      call("POST", kJog, {.body = R"({"axis":"X","distance":NaN,"unit":"mm"})", .headers = {}})
          .status,
      400);
  EXPECT_EQ(
      call("POST", kJog, {.body = R"({"axis":"X","distance":1e999,"unit":"mm"})", .headers = {}})
              .status /
          100,
      4);
  EXPECT_EQ(
      post("/api/v1/machines/nowhere/jog", {{"axis", "X"}, {"distance", 1}, {"unit", "mm"}}).status,
      404);
  EXPECT_TRUE(machines_.jogs.empty());
}

TEST_F(Jog, ThatIsRefusedOrNotAnsweredIsOnRecordAsThat) {
  (void)stored_run(0);
  const Json step{{"axis", "X"}, {"distance", 1}, {"unit", "mm"}};
  machines_.refusal = Error{Errc::Busy, "machine lathe-1 refused jog: the machine is being jogged"};
  expect_error(post(kJog, step), 409, "busy", "is being jogged");
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["detail"],
            "X 1 mm: refused, machine lathe-1 refused jog: the machine is being jogged");
  machines_.refusal = Error{Errc::Timeout, "machine lathe-1 did not answer jog within 17 s"};
  EXPECT_EQ(post(kJog, step).status, 504);
  EXPECT_EQ(json(get("/api/v1/audit"))["entries"][0]["detail"], "X 1 mm: not answered");
}

TEST_F(Jog, IsStoppedByACommandOfItsMachineAlone) {
  const std::string run = stored_run(0);
  const Json stop{{"action", "stop_jog"}};
  ASSERT_EQ(post("/api/v1/machines/lathe-1/commands", stop).status, 200);
  const auto& command = machines_.commands.back();
  EXPECT_EQ(command.action, dds::CommandAction::Abort);
  EXPECT_EQ(command.argument, dds::kJogAbort);
  EXPECT_TRUE(command.run.empty());
  EXPECT_EQ(command.machine, "lathe-1");
  expect_error(post("/api/v1/runs/" + run + "/commands", stop), 422, "unsupported",
               "for a machine");
  expect_error(post("/api/v1/machines/lathe-1/commands", {{"action", "abort"}}), 422, "unsupported",
               "for a run");
}

}  // namespace
}  // namespace dripline::server_test
