// A gateway that drives a board of the Grbl class: real programs on both sides of a pseudo
// terminal.
#include <gtest/gtest.h>
#include <fstream>
#include <sstream>

#include "tests/integration/grbl_system.hpp"
#include "tests/support/dialect_programs.hpp"

namespace dripline::integration {
namespace {

using test_support::BlockEnds;
using test_support::eventually;
using test_support::GrblBoard;

constexpr int kFeed = 3000;

class GrblDialects : public GrblSystem, public testing::WithParamInterface<std::size_t> {};

TEST_P(GrblDialects, PassTheEndOfEveryBlockOfTheSimulatedMachine) {
  const auto& program = test_support::dialect_programs()[GetParam()];
  const BlockEnds expected = test_support::simulated_ends(program);
  start(std::string(program.control));
  system->push(std::string(program.name), std::string(program.text));
  const std::string id = start_run(std::string(program.name));
  nlohmann::json run;
  ASSERT_TRUE(eventually(
      [&] {
        run = system->run(id);
        const auto machine = system->rest().get("/api/v1/machines/lathe-1").json();
        if (machine["status"].value("execution", "") == "PROGRAM_STOPPED")
          (void)system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", "resume"}});
        return run.value("state", "") == "completed" || run.value("state", "") == "alarmed";
      },
      std::chrono::seconds(60)))
      << run.dump();
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("executed", std::uint64_t{0}), expected.rbegin()->first);
  const auto points = board->with([](GrblBoard& peer) { return peer.done; });
  auto at = points.begin();
  GrblBoard::Point last{};
  const auto is_same = [](const auto& a, const auto& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (std::fabs(a[i] - b[i]) > 0.001) return false;
    return true;
  };
  for (const auto& [block, end] : expected) {
    if (is_same(end, last)) continue;
    at = std::find_if(at, points.end(),
                      [&, &point = end](const auto& done) { return is_same(done.at, point); });
    ASSERT_NE(at, points.end()) << "the axes did not pass the end of block " << block;
    last = end;
    ++at;
  }
  EXPECT_EQ(at, points.end());
  EXPECT_FALSE(board->with([](GrblBoard& peer) { return peer.has_overrun; }));
}

INSTANTIATE_TEST_SUITE_P(, GrblDialects, testing::Range<std::size_t>(0, 6), [](const auto& i) {
  std::string name(test_support::dialect_programs()[i.param].control);
  std::erase(name, '-');
  return name;
});

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// deploy/examples/grbl, with the board that its README starts.
TEST_F(GrblSystem, TheExampleRunsOnTheBoardOfItsReadme) {
  const std::string folder = "deploy/examples/grbl/";
  start("fanuc", test_support::example_board(), 20, {"--setup", folder + "setup.toml"});
  system->push("O0104", text_of(folder + "plate.nc"));
  ASSERT_TRUE(eventually([&] { return panel({"home"}).status == 0; }));
  const std::string id = start_run("O0104");
  const auto execution = [&] {
    return system->rest().get("/api/v1/machines/lathe-1").json()["status"].value("execution", "");
  };
  ASSERT_TRUE(eventually([&] { return execution() == "PROGRAM_STOPPED"; })) << "the tool change";
  command(id, "resume");
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  const auto at = board->with([](GrblBoard& peer) { return peer.position(); });
  EXPECT_NEAR(at[0], 40, 1e-3) << "the zero of the part";
  EXPECT_NEAR(at[2], 30, 1e-3);
}

TEST_F(GrblSystem, HoldAndAbortAtThePanelStopHoming) {
  start("rs274ngc", {.is_locked = true, .homing_seconds = 1000}, 1);
  const auto resets = [&] {
    return board->with([](GrblBoard& peer) { return std::ranges::count(peer.real_time, '\x18'); });
  };
  for (const char* verb : {"hold", "abort"}) {
    ASSERT_TRUE(eventually([&] { return panel({"home"}).status == 0; })) << verb;
    const auto before = resets();
    const auto stopped = panel({verb});
    EXPECT_EQ(stopped.status, 0) << stopped.output;
    EXPECT_TRUE(eventually([&] { return resets() > before; })) << verb;
  }
}

TEST_F(GrblSystem, HoldsResumesAndAborts) {
  start();
  system->push("path", straight_program(2000, kFeed));
  const std::string id = start_run("path");
  ASSERT_TRUE(eventually([&] { return system->run(id).value("executed", 0u) > 20; }));
  command(id, "hold");
  const auto execution = [&] {
    return system->rest().get("/api/v1/machines/lathe-1").json()["status"].value("execution", "");
  };
  EXPECT_TRUE(eventually([&] { return execution() == "FEED_HOLD"; })) << execution();
  EXPECT_TRUE(eventually([&] { return rests(); }));
  const auto held_at = traveled();
  command(id, "resume");
  EXPECT_TRUE(eventually([&] { return traveled() > held_at + 20; }));
  command(id, "abort");
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "aborted") << run.dump();
  EXPECT_TRUE(rests());
  EXPECT_LE(run.value("executed", std::size_t{0}), done() + 1) << "the first block does not move";
  const auto second = start_run("path");  // the position is kept: no homing
  EXPECT_TRUE(eventually([&] { return system->run(second).value("executed", 0u) > 2; }));
}

TEST_F(GrblSystem, BlocksKeyedInMoveTheBoardAndAreHeldAndAborted) {
  start();
  const auto key_in = [&](const std::string& text) {
    std::string id, answer;
    EXPECT_TRUE(eventually([&] {
      const auto reply = system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", text}});
      answer = reply.body;
      id = reply.status == 201 ? reply.json().value("id", "") : "";
      return !id.empty();
    })) << answer;
    return id;
  };
  const auto board_x = [&] {
    return board->with([](GrblBoard& peer) { return peer.position()[0]; });
  };
  EXPECT_EQ(system->wait_ended(key_in("G21 G91 G94 F3000 G1 X20\n")).value("state", ""),
            "completed");
  EXPECT_NEAR(board_x(), 20, 1e-3);
  EXPECT_EQ(system->wait_ended(key_in("X5\n")).value("state", ""), "completed");
  EXPECT_NEAR(board_x(), 25, 1e-3) << "G91, G1 and the feed are in force";
  const auto datum = [&] {
    return system->rest().post("/api/v1/machines/lathe-1/datum",
                               {{"offset", "G55"}, {"axis", "X"}, {"value", 5}, {"unit", "mm"}});
  };
  const auto set = datum();
  EXPECT_NE(set.body.find("#5241 is 20.000 mm, it was 0.000 (no tool's length in force"),
            std::string::npos)
      << set.body;
  EXPECT_EQ(system->wait_ended(key_in("G21 G90 G94 F3000 G55 G1 X6\n")).value("state", ""),
            "completed");
  EXPECT_NEAR(board_x(), 26, 1e-3) << "by the datum that was set";
  const std::string id = key_in("G54 X900\n");
  ASSERT_TRUE(eventually([&] { return board_x() > 30; }));
  const auto busy = system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", "G0 X0\n"}});
  EXPECT_EQ(busy.status, 409) << busy.body;
  command(id, "hold");
  EXPECT_TRUE(eventually([&] { return rests(); }));
  command(id, "abort");
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "aborted");
  EXPECT_TRUE(rests());
  EXPECT_LT(board_x(), 900);
}

// A board moves by coordinates: its axes go to those of the tip and the length.
TEST_F(GrblSystem, AToolsLengthInForceIsInTheAxes) {
  const auto setup = std::filesystem::path(testing::TempDir()) / "grbl_length.toml";
  std::ofstream(setup) << "[[tool]]\nnumber = 1\nlength = 10.0\n";
  start("rs274ngc", {}, 20, {"--setup", setup.string()});
  system->push("deep", "G21 G90 G94 F3000\nG1 X5\nG43 H1\nG1 Z-1\nM2\n");
  const auto run = system->wait_ended(start_run("deep"));
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_NEAR(board->with([](GrblBoard& peer) { return peer.position()[0]; }), 5, 1e-3);
  EXPECT_NEAR(board->with([](GrblBoard& peer) { return peer.position()[2]; }), 9, 1e-3);
}

TEST_F(GrblSystem, APulledCableIsAnAlarmAndTheOperatorsResetEndsIt) {
  start();
  system->push("path", straight_program(2000, kFeed));
  const std::string id = start_run("path");
  ASSERT_TRUE(eventually([&] { return system->run(id).value("executed", 0u) > 20; }));
  board->unplug();
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "alarmed") << run.dump();
  EXPECT_NE(run.value("reason", "").find("GRB0005"), std::string::npos) << run.dump();
  EXPECT_NE(run.value("reason", "").find("the position is unknown"), std::string::npos);
  board->plug_in();
  EXPECT_NE(post_run("path").status, 201) << "nothing starts before the operator resets";
  const auto datum = system->rest().post("/api/v1/machines/lathe-1/datum",
                                         {{"offset", "G54"}, {"axis", "X"}, {"value", 0}});
  EXPECT_EQ(datum.status, 409) << datum.body;
  EXPECT_NE(datum.body.find("the position is not known for certain"), std::string::npos)
      << datum.body;
  EXPECT_TRUE(eventually([&] { return rests(); })) << "the board has emptied its buffers";
  press_emergency_stop(true);
  press_emergency_stop(false);
  const auto second = start_run("path");
  EXPECT_TRUE(eventually([&] { return system->run(second).value("executed", 0u) > 2; }));
}

TEST_F(GrblSystem, WhatTheBoardCannotDoIsRefusedBeforeTheFirstMove) {
  start();
  std::string text = "G21 G90 G94 F600\n";
  for (int i = 1; i <= 5000; ++i) text += "G1 X" + std::to_string(i % 100) + "\n";
  system->push("path", text + "M3 S20000\nG1 X9\nM2\n");
  const auto run = system->wait_ended(start_run("path"));
  EXPECT_EQ(run.value("state", ""), "alarmed") << run.dump();
  EXPECT_EQ(run.value("reason", ""),
            "MCH0010 spindle speed 20000 is above the machine's 10000 rpm ($30) (line 5002, found "
            "before the first move)");
  EXPECT_EQ(run.value("executed", 1U), 0U) << run.dump();
  EXPECT_EQ(traveled(), 0);
}

TEST_F(GrblSystem, ALockedBoardIsHomedAtThePanel) {
  start("rs274ngc", {.is_locked = true});
  system->push("path", straight_program(50, kFeed));
  const auto start_reply = [&] { return post_run("path").body; };
  EXPECT_TRUE(eventually([&] { return start_reply().find("home the axes") != std::string::npos; }))
      << start_reply();
  const auto homed = panel({"home"});
  EXPECT_EQ(homed.status, 0) << homed.output;
  EXPECT_EQ(system->wait_ended(start_run("path")).value("state", ""), "completed");
}

TEST_F(GrblSystem, ABoardThatIsResetInTheMidstIsAnAlarm) {
  start();
  system->push("path", straight_program(2000, kFeed));
  const std::string id = start_run("path");
  ASSERT_TRUE(eventually([&] { return system->run(id).value("executed", 0u) > 20; }));
  board->with([](GrblBoard& peer) { peer.restart(); });
  const auto run = system->wait_ended(id);
  EXPECT_NE(run.value("reason", "").find("GRB0004"), std::string::npos) << run.dump();
  EXPECT_TRUE(rests());
}

TEST_F(GrblSystem, AStoppedGatewayHoldsTheBoard) {
  start();
  system->push("path", straight_program(4000, kFeed));
  const std::string id = start_run("path");
  ASSERT_TRUE(eventually([&] { return done() > 20; }));
  system->gateway().signal(SIGTERM);
  EXPECT_EQ(system->gateway().wait(), 0);
  EXPECT_TRUE(rests());
  EXPECT_NE(board->with([](GrblBoard& peer) { return peer.real_time; }).find('!'),
            std::string::npos);
}

}  // namespace
}  // namespace dripline::integration
