// A lathe whose tool drifts, from its first part to a correction that was proposed, approved and
// applied, and that brings the mean back. The part's length is where the tool, with its offset and
// its wear, finds the face; the drift is in the program.
#include <gtest/gtest.h>
#include <cmath>
#include <fstream>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;

/// The face is at Z -1.
constexpr const char* kGateway = R"(units = "mm"
start = { X = 50.0, Z = 80.0 }
[control]
tool_changer = true
[probe]
surface = [ { axis = "Z", at = -1.0 } ]
)";
constexpr const char* kSetup =
    "units = \"mm\"\n\n[[tool]]\nnumber = 3\nwear = { Z = 0.0 }  # finishing\n";
constexpr const char* kTemplate =
    "[[line]]\nform = \"L {actual}\"\ncharacteristic = \"L\"\nnominal = -1.0\nlower = -1.1\nupper "
    "= -0.9\n"
    "tool = \"T3\"\n";
/// Of three values, one that differs is always an outlier.
constexpr const char* kRules = R"([[rule]]
name = "L"
characteristic = "L"
target = "T3.wear.Z"
scale = -1
gain = 1.0
dead_band = 0.005
max_step = 0.1
min_count = 3
window = 3
outlier = 0
)";

/// A simulated probe meets the face in the program's coordinates, whatever the tool's wear is: the
/// program takes the wear in force (P624, Z of offset 3) off, by which a real tool is shifted.
/// `added`: a block before the end.
std::string program(double drift, const std::string& added = "") {
  return fmt::format(
      "O0900\n(TOUCH THE FACE WITH THE TOOL)\nG21 G98\nT0303 M6\nG0 X10.\nZ5.\n"
      "PROBE1 G1 Z-3. F100\nP3=P208+{:.4f}-P624\nPOPEN P0\nDPRNT [L #3]\nPROBE2 Z5. F500\n{}M30\n",
      drift, added);
}

class DriftingLathe : public testing::Test {
 protected:
  DriftingLathe()
      : system_({.speed = "max",
                 .server_arguments = {},
                 .gateway_arguments = {"--setup", write_setup()}}) {}

  std::string write_setup() {
    const std::string path = folder_.path() / "lathe.toml";
    std::ofstream(path) << kGateway;
    return path;
  }
  void put(const std::string& path, const std::string& text) {
    const auto reply = system_.rest().put_bytes("/api/v1/" + path, text);
    ASSERT_TRUE(reply.status >= 200 && reply.status < 300) << path << ": " << reply.body;
  }
  void set_up() {
    system_.start_server();
    system_.start_gateway();
    system_.wait_connected();
    put("machines/lathe-1/setup", kSetup);
    put("report-templates/length", kTemplate);
    put("report-template-assignments/program/O0900/length", "");
    put("machines/lathe-1/offset-rules", kRules);
  }
  /// Runs a part and returns its deviation, as the server measured it.
  double part(double drift, const std::string& added = "") {
    system_.push("O0900", program(drift, added));
    const std::string run = system_.start_run("O0900");
    EXPECT_EQ(system_.wait_ended(run).value("state", ""), "completed");
    json measured;
    EXPECT_TRUE(eventually([&] {
      measured = system_.rest().get("/api/v1/measurements?run=" + run).json();
      return measured.contains("measurements") && !measured["measurements"].empty();
    })) << measured.dump();
    last_run_ = run;
    return measured["measurements"].empty() ? NAN
                                            : measured["measurements"][0].value("deviation", NAN);
  }
  json offsets(const std::string& state) {
    return system_.rest().get("/api/v1/offsets?machine=lathe-1&state=" + state).json()["offsets"];
  }

  test_support::TemporaryFolder folder_;
  System system_;
  std::string last_run_;
};

TEST_F(DriftingLathe, AnApprovedCorrectionBringsTheMeanBack) {
  set_up();
  EXPECT_NEAR(part(0), 0, 0.002);
  EXPECT_NEAR(part(0.015), 0.015, 0.002);
  EXPECT_NEAR(part(0.030), 0.030, 0.002);
  EXPECT_NEAR(part(0.030), 0.030, 0.002);
  const std::string before = last_run_;
  json pending;
  ASSERT_TRUE(eventually([&] {  // of the newest three: a mean of 0.025
    pending = offsets("pending");
    return !pending.empty() && std::abs(pending[0].value("mean", 0.0) - 0.025) < 0.002;
  })) << pending.dump();
  EXPECT_EQ(pending[0]["target"], "T3.wear.Z");
  EXPECT_NEAR(pending[0].value("new_value", 0.0), 0.025, 0.002);
  EXPECT_FALSE(pending[0]["reasons"].empty());

  // The server is killed: what was measured and proposed is still there, once.
  system_.server().kill();
  system_.start_server();
  system_.wait_connected();
  ASSERT_EQ(offsets("pending").size(), 1U);
  EXPECT_EQ(offsets("pending")[0]["id"], pending[0]["id"]);

  const std::string approve =
      "/api/v1/machines/lathe-1/offsets/" + pending[0]["id"].dump() + "/approve";
  const auto approved = system_.rest().post(approve, {{"comment", "checked with a gauge"}});
  ASSERT_EQ(approved.status, 200) << approved.body;
  EXPECT_EQ(approved.json()["state"], "applied");
  EXPECT_EQ(system_.rest().post(approve, json::object()).status, 409) << "once";

  double mean = 0;
  for (int i = 0; i < 3; ++i) mean += part(0.030) / 3;
  EXPECT_NEAR(mean, 0.005, 0.003) << "0.030 of drift, corrected by 0.025";
  const auto setups = system_.rest().get("/api/v1/machines/lathe-1/setups").json();
  EXPECT_EQ(setups["setups"].size(), 2U) << setups.dump();

  const auto history =
      system_.rest().get("/api/v1/machines/lathe-1/offset-history?target=T3").json()["history"];
  ASSERT_EQ(history.size(), 2U) << history.dump();
  EXPECT_EQ(history[0]["runs"].size(), 3U);
  EXPECT_EQ(history[1]["runs"].size(), 4U);
  EXPECT_EQ(history[0]["who"], "admin");
  EXPECT_NE(history[0].value("why", "").find("checked with a gauge"), std::string::npos);
  const auto in_force = [&](const std::string& run) {
    return system_.rest()
        .get("/api/v1/runs/" + run + "/offsets")
        .json()["values"][0]
        .value("value", NAN);
  };
  EXPECT_EQ(in_force(before), 0.0);
  EXPECT_NEAR(in_force(last_run_), 0.025, 0.002);
  const auto chart =
      system_.rest().get("/api/v1/measurements/chart?characteristic=L&machine=lathe-1");
  EXPECT_EQ(chart.status, 200) << chart.body;
  EXPECT_NE(chart.body.find("7 values"), std::string::npos);
}

/// The report is the last thing of the program, so the run is over when the verdict is there: what
/// can be held is the next job.
TEST_F(DriftingLathe, AScrapPartLetsNoJobFollowAlthoughItsRunIsOver) {
  set_up();
  put("report-templates/length", std::string(kTemplate) + "[verdict]\nscrap = \"hold_machine\"\n");
  system_.push("O0900", program(0.5));
  for (int job = 0; job < 2; ++job) {
    const auto added = system_.rest().post("/api/v1/machines/lathe-1/jobs", {{"program", "O0900"}});
    ASSERT_EQ(added.status, 201) << added.body;
  }
  const auto start = [&] {
    return system_.rest().post("/api/v1/machines/lathe-1/start-job", json::object());
  };
  const auto first = start();
  ASSERT_EQ(first.status, 201) << first.body;
  EXPECT_EQ(system_.wait_ended(first.json().value("id", "")).value("state", ""), "completed");
  std::string refusal;
  ASSERT_TRUE(eventually([&] {
    const auto jobs = system_.rest().get("/api/v1/machines/lathe-1/jobs").json();
    refusal = jobs.dump();
    return refusal.find("is scrap") != std::string::npos;
  })) << refusal;
  const auto second = start();
  EXPECT_EQ(second.status, 409) << second.body;
  EXPECT_NE(second.body.find("is scrap"), std::string::npos) << second.body;
}

/// The control's memory goes before the setup: a step from the setup's 0 would be one of -0.03
/// more.
TEST_F(DriftingLathe, NothingFollowsWhereAProgramHasChangedTheWear) {
  set_up();
  part(0.030);
  part(0.030);
  part(0.030, "G10\nP624=0.05\nG11\n");
  json looked;
  ASSERT_TRUE(eventually([&] {
    looked =
        system_.rest().post("/api/v1/machines/lathe-1/offsets/evaluation", json::object()).json();
    return looked.dump().find("T3.wear.Z is 0.05 in the memory of lathe-1 (P624") !=
           std::string::npos;
  })) << looked.dump();
  EXPECT_TRUE(looked["rules"][0]["proposal"].is_null());
  EXPECT_TRUE(offsets("pending").empty());
  EXPECT_TRUE(offsets("applied").empty());
}

}  // namespace
}  // namespace dripline::integration
