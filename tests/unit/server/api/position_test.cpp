// What the handlers answer about setting a datum or a tool's length, and about playback.
#include "tests/unit/server/api/api_fixture.hpp"

namespace dripline::server_test {
namespace {

TEST_F(ApiHandlers, SetADatumAndALengthFromThePosition) {
  const std::string datum = "/api/v1/machines/lathe-1/datum";
  const std::string touch = "/api/v1/machines/lathe-1/touch-off";
  const std::string before = stored_run(0);
  ASSERT_TRUE(store_->runs.set_state(before, storage::RunState::Completed, ""));
  const auto good = post(datum, {{"offset", "G54"}, {"axis", "X"}, {"value", 0.5}, {"unit", "in"}});
  ASSERT_EQ(good.status, 200) << good.body;
  EXPECT_EQ(json(good)["text"], "G54.X is 87.5, it was 100");
  EXPECT_EQ(json(good)["what"], "datum G54 X 0.5 in");
  EXPECT_EQ(json(good)["cells"].dump(),
            R"([{"before":null,"name":"G54.X","unit":"mm","value":87.5}])");
  EXPECT_EQ(json(good)["length"], 2.5);
  EXPECT_TRUE(json(good)["zero"].is_null());
  EXPECT_EQ(machines_.positions.back().argument, "datum G54 X 0.5 in");
  EXPECT_EQ(machines_.positions.back().who, "admin");
  const auto entries = json(get("/api/v1/audit"))["entries"];
  EXPECT_EQ(entries[0]["action"], "machine.datum");
  EXPECT_EQ(entries[0]["detail"], "datum G54 X 0.5 in: G54.X is 87.5, it was 100");
  EXPECT_EQ(entries[1]["detail"], "datum G54 X 0.5 in") << "before it went out";
  EXPECT_EQ(post(touch, {{"tool", 3}, {"offset", "G54"}, {"axis", "Z"}, {"value", 0}}).status, 200);
  EXPECT_EQ(machines_.positions.back().argument, "tool 3 Z 0 mm G54");
  EXPECT_EQ(post(datum, {{"axis", "C"}, {"value", 90}}).status, 200);
  EXPECT_EQ(machines_.positions.back().argument, "datum C 90 deg");
  machines_.details.clear();  // as an older gateway answers
  const auto turned = post(datum, {{"axis", "C"}, {"value", 90}, {"unit", "deg"}});
  EXPECT_EQ(turned.status, 200) << turned.body;
  EXPECT_TRUE(json(turned)["cells"].empty());
  EXPECT_TRUE(json(turned)["length"].is_null());
  EXPECT_EQ(post(datum, {{"offset", "g54.1p7"}, {"axis", "X"}, {"value", 0}}).status, 200);
  EXPECT_EQ(machines_.positions.back().argument, "datum G54.1P7 X 0 mm");
  const std::size_t sent = machines_.positions.size();
  for (const char* unit : {"mm", "in"}) {
    expect_error(post(datum, {{"axis", "C"}, {"value", 90}, {"unit", unit}}), 400, "syntax",
                 "its value is in degrees");
  }
  expect_error(post(datum, {{"axis", "X"}, {"value", 5}, {"unit", "deg"}}), 400, "syntax", "'deg'");
  expect_error(post(datum, {{"axis", "X"}, {"value", 5}}), 400, "syntax", "needs a unit");
  expect_error(post(datum, {{"axis", "Q"}, {"value", 0}}), 400, "syntax", "axis 'Q'");
  expect_error(post(datum, {{"axis", "X"}}), 400, "syntax", "value is missing");
  expect_error(post(datum, {{"axis", "X"}, {"value", 1e9}, {"unit", "mm"}}), 413, "limit_exceeded",
               "1000000000");
  expect_error(post(datum, {{"axis", "X"}, {"value", 1}, {"unit", "m"}}), 400, "syntax", "'m'");
  expect_error(post(datum, {{"axis", "X"}, {"value", 0}, {"offset", "G54 X"}}), 400, "syntax",
               "offset 'G54 X' is no name of one: G54");
  expect_error(post(datum, {{"axis", "X"}, {"value", 0}, {"tool", 3}}), 400, "syntax", "tool");
  expect_error(post(touch, {{"axis", "X"}, {"value", 0}}), 400, "syntax", "tool is missing");
  EXPECT_EQ(post("/api/v1/machines/nowhere/datum", {{"axis", "X"}, {"value", 0}}).status, 404);
  const auto revision = store_->programs.revision("O0100", 1).value();
  ASSERT_TRUE(store_->runs.create(run_of(revision, "run-9")));
  expect_error(post(datum, {{"axis", "X"}, {"value", 0}}), 409, "busy", "is busy with run");
  EXPECT_EQ(machines_.positions.size(), sent) << "nothing went out";
}

TEST_F(ApiHandlers, NoteARefusedDatumInTheAuditTrail) {
  const std::string before = stored_run(0);
  ASSERT_TRUE(store_->runs.set_state(before, storage::RunState::Completed, ""));
  machines_.refusal = Error{Errc::Busy, "machine lathe-1 refused set_position: the axes move"};
  expect_error(post("/api/v1/machines/lathe-1/datum", {{"axis", "X"}, {"value", 0}}), 409, "busy",
               "the axes move");
  const auto entry = json(get("/api/v1/audit"))["entries"][0];
  EXPECT_EQ(entry["detail"],
            "datum X 0 mm: refused, machine lathe-1 refused set_position: the axes move");
}

TEST_F(ApiHandlers, GiveThePositionAsABlock) {
  (void)stored_run(0);
  const std::string path = "/api/v1/machines/lathe-1/playback";
  EXPECT_EQ(json(get(path + "?axes=XY"))["block"], "L X+1.000 Y-2.500 R0");
  EXPECT_TRUE(machines_.positions.back().is_playback);
  expect_error(get(path), 400, "syntax", "letters");
  expect_error(get(path + "?axes=xy"), 400, "syntax", "'xy'");
}

}  // namespace
}  // namespace dripline::server_test
