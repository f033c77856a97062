#include "clients/lib/api_json.hpp"

#include <gtest/gtest.h>

#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

namespace dripline::client {
namespace {

nlohmann::json status_json() {
  return nlohmann::json::parse(R"({"time":"2026-11-21T07:40:06Z","execution":"Active",
      "mode":"Automatic","run":"r1","program":"O1","sent":10,"accepted":3,"executed":2,
      "total_bytes":20,"offset":5,"line":2,"sequence":20,"position":{"X":1.5,"Z":-2},
      "feed_mm_per_min":100,"spindle_rpm":0,"feed_override":1,"rapid_override":0.25,
      "spindle_override":1,"buffered_seconds":0.5,"single_block":false,"message":null,
      "outbox":0,"modes":{"motion":"line","compensation":"left","units":"inch","incremental":false,
      "feed_unit":"per_revolution","feed":0.25,"feed_limited":true,"tool":3,"next_tool":null,
      "tool_offset":13,"tool_length_x":1.5,"tool_length_z":-2,"tool_radius":0.8,
      "work_system":"G54","cycle":null,"dwell_seconds":0,"surface_speed":false,"spindle_speed":800,
      "spindle_load":null,"flood":true,"mist":false,"tool_axis":"Z","spindle":"clockwise"},
      "coordinates":{"target":{"X":2,"Z":-2},"distance_to_go":{"X":0.5,"Z":0},
      "following_error":{"X":0,"Z":0},"program":{"position":{"X":1,"Z":2},"target":{"X":1.5,"Z":2},
      "datum":{"X":1,"Z":0},"shift":{"X":-0.5,"Z":0},"rotation":30,"basic_rotation":0.5,
      "scale":{"X":0.5,"Z":1},"mirrored":["X"],"pole":{"X":3,"Y":4}}},
      "emergency_stop":true,"remote_enable":"not_given","waits_for":"cycle_start",
      "jog":{"step":1.0,"feed":300.0,"moving":true,"refusal":null},
      "switches":{"optional_stop":"on","block_skip":"off","skip_levels":"2,9","dry_run":null,
      "machine_lock":null,"handwheel":"off","test_run":"off"}})");
}

TEST(ApiJson, ReadsAMachineWithItsStatus) {
  auto json = test_support::machine_json("lathe-1");
  json["status"] = status_json();
  const auto machine = from_json<client::Machine>(json);
  ASSERT_TRUE(machine) << machine.error().what;
  ASSERT_TRUE(machine->status);
  EXPECT_EQ(machine->status->position.at("Z"), -2);
  EXPECT_EQ(machine->status->sequence, 20);
  EXPECT_EQ(machine->status->message, "");
  ASSERT_TRUE(machine->status->jog);
  EXPECT_TRUE(machine->status->jog->moving);
  EXPECT_EQ(machine->status->jog->refusal, "");
  ASSERT_TRUE(machine->status->switches);
  EXPECT_EQ(machine->status->switches->optional_stop, "on");
  EXPECT_EQ(machine->status->switches->dry_run, "");
  ASSERT_TRUE(machine->status->modes);
  EXPECT_EQ(machine->status->modes->tool, 3);
  EXPECT_EQ(machine->status->modes->next_tool, std::nullopt);
  EXPECT_EQ(machine->status->modes->work_system, "G54");
}

TEST(ApiJson, ReadsAStatusOfAnOlderServer) {
  auto json = test_support::machine_json("lathe-1");
  json["status"] = status_json();
  json["status"]["modes"].erase("tool_axis");
  json["status"]["modes"].erase("spindle");
  EXPECT_EQ(from_json<client::Machine>(json)->status->modes->spindle, "");
  json["status"].erase("modes");
  json["status"].erase("coordinates");
  json["status"].erase("emergency_stop");
  json["status"].erase("remote_enable");
  json["status"].erase("waits_for");
  const auto machine = from_json<client::Machine>(json);
  ASSERT_TRUE(machine) << machine.error().what;
  EXPECT_FALSE(machine->status->modes);
  EXPECT_FALSE(machine->status->coordinates);
  EXPECT_FALSE(machine->status->emergency_stop);
  EXPECT_EQ(machine->status->remote_enable, "");
}

TEST(ApiJson, GivesBackWhatItRead) {
  auto machine = test_support::machine_json("lathe-1");
  machine["status"] = status_json();
  machine["status"]["screen"] = {{"units", "inch"},           {"position", "distance_to_go"},
                                 {"previous_block", nullptr}, {"block", "N2 X2"},
                                 {"next_block", "N3 X3"},     {"further_block", nullptr}};
  machine["display"] = nullptr;  // from a server before it
  machine["starts"] = nullptr;
  machine["positions"] = nullptr;
  machine["held"] = nullptr;
  machine["queue_hold"] = nullptr;
  machine["stale"] = false;
  machine["unconfirmed_gateway"] = nullptr;
  EXPECT_EQ(nlohmann::json(to_json_value(*from_json<client::Machine>(machine))), machine);
  auto run = test_support::run_json("r1", "completed");
  run["job"] = nullptr;
  run["statistics"] = {{"motion_seconds", 2.5},
                       {"distance_mm", 0.25},
                       {"average_feed_mm_per_min", 6.5},
                       {"average_block_seconds", nullptr},
                       {"blocks_per_second", 0.5}};
  run["test"] = true;
  EXPECT_EQ(nlohmann::json(to_json_value(*from_json<client::Run>(run))), run);
}

TEST(ApiJson, KeepsTheDocumentedOrder) {
  const std::string text = to_json_value(Report{"r", "m", "p", 1, "completed", 3, "", ""}).dump();
  EXPECT_EQ(text, R"({"run":"r","machine":"m","program":"p","revision":1,"state":"completed",)"
                  R"("lines":3,"started":null,"ended":null})");
}

TEST(ApiJson, IgnoresMembersItDoesNotKnow) {
  auto json = test_support::run_json("r1", "active");
  json["color"] = "blue";
  EXPECT_TRUE(from_json<client::Run>(json));
}

TEST(ApiJson, NamesWhatIsMissingOrOfTheWrongKind) {
  auto json = test_support::run_json("r1", "active");
  json.erase("executed");
  EXPECT_EQ(from_json<client::Run>(json).error().what, "member \"executed\" is missing");
  json["executed"] = "many";
  EXPECT_EQ(from_json<client::Run>(json).error().what,
            "member \"executed\" is not a whole number >= 0");
  auto machine = test_support::machine_json("lathe-1");
  machine["status"] = status_json();
  machine["status"]["feed_override"] = nullptr;
  EXPECT_EQ(from_json<client::Machine>(machine).error().what,
            "member \"feed_override\" is missing of \"status\"");
}

TEST(ApiJson, ReadsRevisionsOfAServerThatKnowsNoHeldOnes) {
  const auto revision = from_json<Revision>(nlohmann::json::parse(
      R"({"program":"p","revision":1,"size":4,"sha256":"ab","created":"t"})"));
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_FALSE(revision->held);
}

TEST(ApiJson, ReadsAHistory) {
  const auto json = nlohmann::json::parse(
      R"({"name":"p","revision":1,"size":4,"sha256":"ab","control":null,"comment":null,"title":null,
          "author":null,"created":"t","held":false,"accepted":null,"held_revisions":1,"cam_file":null,
          "part":null,"operation":null,"material":null,"machine_group":null,
          "state":"released","released":"t","withdrawn":null,"revisions":[{"program":"p","revision":1,"size":4,
          "sha256":"ab","control":null,"comment":"c","title":"FLANGE","author":null,"created":"t",
          "held":true,"accepted":"u","state":"draft","released":null,"withdrawn":null,"cam_file":null}]})");
  const auto history = from_json<ProgramHistory>(json);
  ASSERT_TRUE(history) << history.error().what;
  EXPECT_EQ(history->program.revisions, 1u);
  EXPECT_EQ(history->revisions.at(0).comment, "c");
  EXPECT_TRUE(history->revisions.at(0).held);
  EXPECT_EQ(history->program.held_revisions, 1u);
  EXPECT_EQ(history->program.state, "released");
  EXPECT_EQ(nlohmann::json(to_json_value(*history)), json);
}

}  // namespace
}  // namespace dripline::client
