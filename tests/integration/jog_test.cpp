// Jogs with real processes: a server, a gateway, `dnc` as its users type it, and a board of the
// Grbl class.
#include <gtest/gtest.h>
#include <array>
#include <thread>

#include "tests/integration/grbl_system.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;
using test_support::GrblBoard;
using Reply = test_support::RestClient::Reply;

class JogSystem : public GrblSystem {
 protected:
  void begin(const std::vector<std::string>& more = {"--jog-step", "50", "--jog-feed", "3000"}) {
    system.emplace(System::Options{
        .speed = "1x", .server_arguments = {}, .gateway_arguments = more, .control = "fanuc"});
    system->start_server();
    start_gateway();
  }
  Reply jog(double distance, double feed = 3000, const char* axis = "X") {
    return system->rest().post(
        "/api/v1/machines/lathe-1/jog",
        {{"axis", axis}, {"distance", distance}, {"unit", "mm"}, {"feed", feed}});
  }
  json status() { return system->rest().get("/api/v1/machines/lathe-1").json()["status"]; }
  double x() {
    const json now = status();
    return now.is_object() ? now["position"].value("X", -1e9) : -1e9;
  }
  bool is_moving() {
    const json now = status();
    return now.is_object() && now["jog"].is_object() && now["jog"]["moving"] == true;
  }
  double board_x() {
    return board->with([](GrblBoard& peer) { return peer.position()[0]; });
  }
  std::size_t board_jogs() {
    return board->with([](GrblBoard& peer) { return peer.jogs.size(); });
  }
  test_support::Finished dnc(const std::string& arguments) {
    return test_support::run_to_end(
        {"/bin/sh", "-c",
         program_path("dnc") + " --server " + system->url() + " --state " +
             system->server_state().string() + " " + arguments},
        system->folder() / "dnc.out");
  }
};

TEST_F(JogSystem, IsTypedShownAndOnRecord) {
  begin();
  const auto done = dnc("machine jog lathe-1 X -2.5 --unit mm");
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_EQ(done.output, "lathe-1: X -2.5 mm\n");
  EXPECT_TRUE(eventually([&] { return x() == -2.5; })) << status().dump();
  const auto too_far = dnc("machine jog lathe-1 X 51");
  EXPECT_EQ(too_far.status, 1) << too_far.output;
  EXPECT_NE(too_far.output.find("a step of 51 mm: this gateway takes 50 at most"),
            std::string::npos)
      << too_far.output;
  const auto none = dnc("machine stop-jog lathe-1");
  EXPECT_EQ(none.status, 1) << none.output;
  EXPECT_NE(none.output.find("nothing is jogged"), std::string::npos) << none.output;
  const json trail = system->rest().get("/api/v1/audit?limit=1000").json()["entries"];
  std::vector<std::string> details;
  for (const json& entry : trail)
    if (entry.value("action", "") == "machine.jog") details.push_back(entry.value("detail", ""));
  ASSERT_EQ(details.size(), 4U) << "each asked, and what came of it";
  EXPECT_EQ(details[3], "X -2.5 mm");
  EXPECT_EQ(details[2], "X -2.5 mm: X -2.5 mm");
}

/// Keys as a terminal repeats them, through a pipe.
TEST_F(JogSystem, IsHeldByAKeyAndStopsWhenItsRepeatsEnd) {
  begin();
  const auto hold = [&](const std::string& keys) {
    return test_support::run_to_end(
        {"/bin/sh", "-c",
         "(" + keys + ") | " + program_path("dnc") + " --server " + system->url() + " --state " +
             system->server_state().string() +
             " machine jog lathe-1 X 50 --unit mm --feed 300 --hold"},
        system->folder() / "dnc.out");
  };
  const auto touched = hold("printf k");
  EXPECT_EQ(touched.status, 1) << touched.output;
  EXPECT_NE(touched.output.find("nothing has moved"), std::string::npos) << touched.output;
  EXPECT_EQ(x(), 0);
  const auto held = hold("for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14; do printf k; sleep 0.1; done");
  EXPECT_EQ(held.status, 0) << held.output;
  EXPECT_NE(held.output.find("stopped"), std::string::npos) << held.output;
  EXPECT_TRUE(eventually([&] { return !is_moving(); }));
  const double at = x();
  EXPECT_GT(at, 0);
  EXPECT_LT(at, 40) << "50 mm would take 10 s";
  EXPECT_EQ(dnc("machine stop-jog lathe-1").status, 1) << "nothing is jogged";
  EXPECT_EQ(x(), at);
}

TEST_F(JogSystem, OneOfManyAtOnceMovesAndAStopEndsIt) {
  begin();
  std::array<Reply, 4> replies;
  std::vector<std::thread> senders;
  for (std::size_t i = 0; i < replies.size(); ++i)
    senders.emplace_back([&, i] { replies[i] = jog(10, 1200); });
  for (auto& sender : senders) sender.join();
  int moved = 0;
  for (const Reply& reply : replies) {
    moved += reply.status == 200 ? 1 : 0;
    if (reply.status != 200) {
      EXPECT_EQ(reply.status, 409) << reply.body;
    }
  }
  EXPECT_GE(moved, 1);
  EXPECT_TRUE(eventually([&] { return x() == 10.0 * moved; })) << status().dump();
  Reply stopped;
  std::thread mover([&] { stopped = jog(50, 600); });
  EXPECT_TRUE(eventually([&] { return is_moving() && x() > 10.0 * moved + 1; }));
  const Reply stop =
      system->rest().post("/api/v1/machines/lathe-1/commands", {{"action", "stop_jog"}});
  mover.join();
  EXPECT_EQ(stop.status, 200) << stop.body;
  ASSERT_EQ(stopped.status, 200) << stopped.body;
  EXPECT_EQ(stopped.json()["reached"], false);
  const double at = stopped.json()["position"];
  EXPECT_LT(at, 10.0 * moved + 49);
  EXPECT_TRUE(eventually([&] { return !is_moving() && std::abs(x() - at) < 0.001; }));
}

TEST_F(JogSystem, ARunAndAJogExcludeEachOtherAndMdiGoesOnFromThere) {
  begin();
  system->push("O1", "O1\nG21 G90 G1 X5. F150\nM30\n");
  const std::string run = start_run("O1");
  const Reply refused = jog(1);
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("is active"), std::string::npos) << refused.body;
  EXPECT_EQ(system->wait_ended(run).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return x() == 5; }));
  Reply done;
  std::thread mover([&] { done = jog(5, 300); });
  EXPECT_TRUE(eventually([&] { return is_moving(); }));
  const Reply start = post_run("O1");
  EXPECT_EQ(start.status, 409) << start.body;
  EXPECT_NE(start.body.find("being jogged"), std::string::npos) << start.body;
  mover.join();
  EXPECT_EQ(done.status, 200) << done.body;
  const Reply mdi =
      system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", "G21 G91 G1 X1. F3000\n"}});
  ASSERT_EQ(mdi.status, 201) << mdi.body;
  EXPECT_NE(mdi.body.find("the axes were moved since"), std::string::npos) << mdi.body;
  EXPECT_EQ(system->wait_ended(mdi.json().value("id", "")).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return x() == 11; })) << status().dump();
}

TEST_F(JogSystem, ABoardIsJoggedAndGoesOnFromThere) {
  start("fanuc", {}, 1, {"--jog-step", "50", "--jog-feed", "3000"});
  std::string answer;
  ASSERT_TRUE(eventually([&] {
    const Reply reply = jog(2.5);
    answer = reply.body;
    return reply.status == 200;
  })) << answer;
  EXPECT_NEAR(board_x(), 2.5, 1e-3);
  const Reply mdi =
      system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", "G21 G91 G1 X1. F3000\n"}});
  ASSERT_EQ(mdi.status, 201) << mdi.body;
  EXPECT_EQ(system->wait_ended(mdi.json().value("id", "")).value("state", ""), "completed");
  EXPECT_NEAR(board_x(), 3.5, 1e-3);
  Reply stopped;
  std::thread mover([&] { stopped = jog(50, 600); });
  EXPECT_TRUE(eventually([&] { return board_x() > 5; }));
  press_emergency_stop(true);
  mover.join();
  EXPECT_TRUE(rests());
  EXPECT_LT(board_x(), 50);
  press_emergency_stop(false);
}

/// The board ends what it has; the next process does not begin it again.
TEST_F(JogSystem, AKilledGatewayMovesNothingTwice) {
  start("fanuc", {}, 1, {"--jog-step", "50", "--jog-feed", "3000"});
  ASSERT_TRUE(eventually([&] { return jog(1).status == 200; }));
  const std::size_t jogs = board_jogs();
  Reply lost;
  std::thread mover([&] { lost = jog(5, 300); });
  EXPECT_TRUE(eventually([&] { return board_x() > 1.5; }));
  system->gateway().kill();
  start_gateway();
  mover.join();
  EXPECT_EQ(lost.status, 504) << lost.body;
  EXPECT_TRUE(eventually([&] { return rests() && rests(); }));
  EXPECT_LE(board_x(), 6 + 1e-3);
  EXPECT_EQ(board_jogs(), jogs + 1);
  EXPECT_TRUE(eventually([&] { return std::abs(x() - board_x()) < 0.01; })) << status().dump();
}

}  // namespace
}  // namespace dripline::integration
