// Why a machine is held: a verdict comes while its run still moves, and everybody who looks at the
// machine, the run or the queue reads what was measured. Then a TNC, whose tool store has no wear:
// from measured parts to the text that the control takes.
#include <gtest/gtest.h>
#include <fstream>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;

class Shop : public testing::Test {
 protected:
  explicit Shop(System::Options options) : system_(std::move(options)) {}

  void put(const std::string& path, const std::string& text) {
    const auto reply = system_.rest().put_bytes("/api/v1/" + path, text);
    ASSERT_TRUE(reply.status >= 200 && reply.status < 300) << path << ": " << reply.body;
  }
  std::string dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system_.server_state()});
    const auto done = test_support::run_to_end(arguments, system_.folder() / "dnc.out");
    EXPECT_EQ(done.status, 0) << done.output;
    return done.output;
  }
  json machine(const std::string& name = "lathe-1") {
    return system_.rest().get("/api/v1/machines/" + name).json();
  }
  System system_;
};

/// At its own speed, so that it still moves when the verdict is there.
class HeldLathe : public Shop {
 protected:
  HeldLathe() : Shop({.speed = "1x", .server_arguments = {}, .gateway_arguments = {}}) {}

  void wait_held() {
    ASSERT_TRUE(eventually([&] {
      const json now = machine();
      return !now["held"].is_null() && now["status"].value("execution", "") == "FEED_HOLD";
    })) << machine().dump();
  }
};

constexpr const char* kWhy =
    "part 1, serial S7, is scrap: D40 is 40.3 mm, 0.25 above the upper limit 40.05";

TEST_F(HeldLathe, EverybodyReadsWhatWasMeasuredUntilItIsResumed) {
  system_.start_server();
  system_.start_gateway();
  system_.wait_connected();
  put("report-templates/bore",
      "[[line]]\nform = \"D {serial} {actual}\"\ncharacteristic = \"D40\"\nnominal = 40\n"
      "tolerance = 0.05\n[verdict]\nscrap = \"hold_machine\"\n");
  put("report-template-assignments/program/O0900/bore", "");
  system_.push("O0900", "O0900\nG21 G98\nPOPEN P0\nDPRNT [D S7 40.3]\nG1 X500. F60.\nM30\n");
  const std::string run = system_.start_run("O0900");
  wait_held();
  const json held = machine()["held"];
  EXPECT_EQ(held["reason"], kWhy);
  EXPECT_EQ(held["who"], "report template bore version 1");
  EXPECT_EQ(held["run"], run);
  EXPECT_EQ(machine()["queue_hold"]["reason"], kWhy);
  EXPECT_EQ(system_.run(run)["held"]["reason"], kWhy);
  EXPECT_EQ(system_.rest().get("/api/v1/machines/lathe-1/jobs").json()["hold"]["reason"], kWhy);
  for (const auto& words : std::vector<std::vector<std::string>>{{"machine", "status", "lathe-1"},
                                                                 {"machine", "list"},
                                                                 {"run", "show", run},
                                                                 {"job", "list", "lathe-1"}}) {
    EXPECT_NE(dnc(words).find(kWhy), std::string::npos) << words[0] << " " << words[1];
  }

  system_.server().kill();
  system_.start_server();
  system_.wait_connected();
  wait_held();
  EXPECT_EQ(machine()["held"]["reason"], kWhy);

  EXPECT_EQ(system_.rest().post("/api/v1/runs/" + run + "/commands", {{"action", "resume"}}).status,
            200);
  ASSERT_TRUE(eventually([&] { return machine()["status"].value("execution", "") == "ACTIVE"; }))
      << machine().dump();
  EXPECT_TRUE(machine()["held"].is_null());
  EXPECT_EQ(machine()["queue_hold"]["reason"], kWhy) << "until someone releases it";
  // A person's hold has his name.
  EXPECT_EQ(system_.rest().post("/api/v1/runs/" + run + "/commands", {{"action", "hold"}}).status,
            200);
  wait_held();
  EXPECT_EQ(machine()["held"]["who"], "admin");
  EXPECT_TRUE(machine()["held"]["reason"].is_null());
  EXPECT_EQ(system_.rest().post("/api/v1/runs/" + run + "/commands", {{"action", "abort"}}).status,
            200);
  system_.wait_ended(run);
  EXPECT_TRUE(machine()["held"].is_null());
  EXPECT_TRUE(system_.run(run)["held"].is_null());
}

class MeasuredMill : public Shop {
 protected:
  MeasuredMill()
      : Shop({.speed = "max",
              .server_arguments = {},
              .gateway_arguments = {},
              .control = "tnc155"}) {}
  std::string write_probe() {
    const std::string path = system_.folder() / "mill.toml";
    std::ofstream(path) << "start = { Z = 50.0 }\n[probe]\nsurface = [ { axis = \"Z\", at = -1.0 "
                           "} ]\n";
    return path;
  }
};

TEST_F(MeasuredMill, ACorrectionOfATncIsOneOfItsLengthOrRadius) {
  system_.start_server();
  system_.use_gateway_arguments({"--setup", write_probe()});
  system_.start_gateway("mill-3");
  system_.wait_connected("mill-3");
  put("machines/mill-3/setup",
      "units = \"mm\"\n\n[[tool]]\nnumber = 3\nlength = 50.0  # presetter\nradius = 5.0\n");
  put("report-templates/pocket",
      "sources = [\"probe\"]\n[[line]]\nform = \"PROBE contact X {x:number} Y {y:number} Z "
      "{actual}\"\ncharacteristic = \"depth\"\nnominal = -1.02\ntool = \"T3\"\n");
  put("report-template-assignments/machine/mill-3/pocket", "");
  const auto rule = [](const char* target) {
    return fmt::format(
        "[[rule]]\nname = \"depth\"\ncharacteristic = \"depth\"\ntarget = \"{}\"\nprogram = "
        "\"1\"\ntool = 3\nscale = -1\ngain = 1.0\nmax_step = 0.1\nmin_count = 2\n",
        target);
  };
  const std::string rules = "/api/v1/machines/mill-3/offset-rules";
  const auto refused = system_.rest().put_bytes(rules, rule("T3.wear.Z"));
  EXPECT_EQ(refused.status, 422) << refused.body;
  EXPECT_NE(refused.body.find("rule depth: target T3.wear.Z: tnc155 has no wear.Z of a tool"),
            std::string::npos)
      << refused.body;
  put("machines/mill-3/offset-rules", rule("T3.length"));
  system_.push("1",
               "0 BEGIN PGM 1 MM\n1 TOOL CALL 3 Z S1\n2 TCH PROBE 0.0 REF. PLANE Q10 Z-\n"
               "3 TCH PROBE 0.1 X+0 Y+0 Z+0\n4 END PGM 1 MM\n");
  for (int part = 0; part < 2; ++part)
    EXPECT_EQ(system_.wait_ended(system_.start_run("1", "mill-3")).value("state", ""), "completed");
  json pending;
  ASSERT_TRUE(eventually([&] {
    pending = system_.rest().get("/api/v1/offsets?machine=mill-3&state=pending").json()["offsets"];
    return !pending.empty() && pending[0].value("used", 0) == 2;
  })) << pending.dump()
      << system_.rest().get("/api/v1/measurements?machine=mill-3").body;
  EXPECT_NEAR(pending[0].value("new_value", 0.0), 50.02, 1e-6) << pending.dump();
  dnc({"offset", "approve", pending[0]["id"].dump()});
  EXPECT_NE(dnc({"setup", "show", "mill-3"}).find("50.02"), std::string::npos);
  const std::string exported = dnc({"setup", "export", "mill-3"});
  EXPECT_NE(exported.find("50,02"), std::string::npos) << exported;
  EXPECT_NE(dnc({"offset", "history", "mill-3", "T3.length"}).find("50.02"), std::string::npos);
}

}  // namespace
}  // namespace dripline::integration
