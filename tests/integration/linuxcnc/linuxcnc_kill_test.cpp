// Gateway, server, helper and LinuxCNC itself killed at random moments of a run, which is then
// restarted. The witness is a component of LinuxCNC's own. DRIPLINE_KILLS changes how often.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "tests/integration/motion_system.hpp"
#include "tests/support/linuxcnc/linuxcnc.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::LinuxCnc;

constexpr int kFeed = 6000;  ///< a block of 1 mm takes 10 ms
constexpr int kMoves = 150;
constexpr double kStep = 0.005;

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 10;
}

/// The child of a process that is the helper.
pid_t helper_of(pid_t gateway) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const int pid = std::atoi(entry.path().filename().c_str());
    std::string name, state;
    int number = 0, parent = 0;
    if (pid > 0) std::ifstream(entry.path() / "stat") >> number >> name >> state >> parent;
    if (pid > 0 && parent == gateway && name == "(python3)" && state != "Z") return pid;
  }
  return 0;
}

class LinuxCncKill : public MotionSystem {
 protected:
  void SetUp() override {
    if (const std::string missing = LinuxCnc::missing(); !missing.empty())
      GTEST_SKIP() << "skipped: " << missing;
    linuxcnc.emplace();
    linuxcnc->start();
    gateway_environment = {"TMPDIR=" + temporary.path().string()};
    start_system("rs274ngc", "linuxcnc:" + linuxcnc->ini());
    system->push("path", straight_program(kMoves, kFeed));
    system->push("back", "G21 G90 G0 X0\nM2\n");
    turn_on("home");
  }
  /// What the operator does after LinuxCNC's start, or after an alarm.
  void turn_on(const char* verb) {
    test_support::Finished last;
    const auto obeys = [&] {
      last = panel({verb});
      return last.status == 0;
    };
    ASSERT_TRUE(eventually([&] {  // the first reset may come before the gateway has its helper
      press_emergency_stop(true);
      press_emergency_stop(false);
      return eventually(obeys, std::chrono::seconds(3));
    })) << last.output
        << linuxcnc->log();
  }
  double x() const { return linuxcnc->position()[0]; }
  bool rests() {
    // Its task may get no processor for a while: the axes wait for it then.
    return eventually([&] { return linuxcnc->rests(std::chrono::seconds(1)); });
  }
  /// Block 1 is the line of modes: block n + 1 ends at X n.
  std::size_t blocks_done() const { return static_cast<std::size_t>(x() + kStep) + 1; }
  /// The axes go in one direction only, from somewhere up to `last`.
  void expect_path(double first, double last) {
    double at = first;
    for (const auto& sample : linuxcnc->samples()) {
      ASSERT_GE(sample.at[0], at - 1e-6) << "cut twice";
      ASSERT_EQ(sample.at[1], 0);
      at = sample.at[0];
    }
    EXPECT_NEAR(at, last, 1e-6);
  }
  /// One run from X 0, cut off by `cut` at a random moment.
  template <class Cut>
  void cut_off(Cut cut) {
    if (x() != 0) {
      const auto back = system->wait_ended(start_run("back"));
      ASSERT_EQ(back.value("state", ""), "completed") << back.dump();
      ASSERT_TRUE(rests());
    }
    linuxcnc->reset();
    id = start_run("path");
    ASSERT_TRUE(eventually([&] { return x() > 1; })) << system->run(id).dump();
    // The moment is the test's subject, so here it does sleep.
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<>(0, 1200)(random)));
    cut();
    ASSERT_TRUE(rests());
    expect_path(0, x());
    truth = blocks_done();
  }
  /// The restart reports where the axes have shown the run to be, moves nothing before cycle start,
  /// and completes the part.
  void restart(const nlohmann::json& cut, const std::string& at = {}) {
    linuxcnc->reset();
    const double before = x();
    auto body = nlohmann::json::object();
    if (!at.empty()) body["at"] = at;
    std::string text, again;
    ASSERT_TRUE(eventually([&] {
      const auto reply =
          system->rest().post("/api/v1/runs/" + cut.value("id", "") + "/restart", body);
      text = reply.body;
      if (reply.status == 201) again = reply.json().value("id", "");
      return reply.status == 201;
    })) << text;
    nlohmann::json report;
    ASSERT_TRUE(eventually([&] {
      report = system->restart_report(again);
      return report.is_object();
    })) << system->run(again).dump();
    EXPECT_EQ(report["after"]["block"], truth) << report.dump() << cut.dump();
    EXPECT_TRUE(linuxcnc->rests());
    EXPECT_EQ(x(), before) << "nothing moves before cycle start";
    start_cycle(again);
    const auto whole = system->wait_ended(again);
    EXPECT_EQ(whole.value("state", ""), "completed") << whole.dump();
    EXPECT_EQ(whole.value("executed", 0), kMoves + 2) << whole.dump();
    ASSERT_TRUE(rests());
    const auto samples = linuxcnc->samples();
    const auto lowest = std::min_element(samples.begin(), samples.end(),
                                         [](auto& a, auto& b) { return a.at[0] < b.at[0]; });
    ASSERT_NE(lowest, samples.end());
    // The interrupted block from its beginning on.
    const double first = std::min(before, static_cast<double>(truth) - 1);
    EXPECT_NEAR(lowest->at[0], first, 0.001);
    for (auto one = lowest; one + 1 < samples.end(); ++one)
      ASSERT_LE(one->at[0], (one + 1)->at[0] + 1e-6) << "cut twice";
    EXPECT_NEAR(x(), kMoves, 1e-6);
    ++restarts;
  }
  /// Who gets no answer in time from a busy computer presses again.
  void start_cycle(const std::string& run) {
    bool has_no_answer = false;
    std::string text;
    ASSERT_TRUE(eventually([&] {
      const auto reply = post_command(run, "resume");
      text = reply.body;
      constexpr int kNoAnswer = 504;
      if (reply.status == kNoAnswer) has_no_answer = true;
      return reply.status == 200 || (has_no_answer && reply.status != kNoAnswer);
    })) << text;
  }
  void restart_server() {
    system->start_server();
    system->wait_connected();
  }
  void TearDown() override {
    if (IsSkipped()) return;
    EXPECT_TRUE(std::filesystem::is_empty(temporary.path())) << "a FIFO is still there";
    std::printf("%d restarts\n", restarts);
  }

  std::mt19937 random{20'261'123};
  test_support::TemporaryFolder temporary;
  std::optional<LinuxCnc> linuxcnc;
  std::string id;
  std::size_t truth = 0;
  int restarts = 0;
};

TEST_F(LinuxCncKill, OfGatewayServerAndHelperCutsNothingTwiceAndLeavesNothingOut) {
  enum Kind { kGateway, kBoth, kHelper, kGatewayAndHelper, kServer, kKinds };
  for (int kill = 0; kill < kills() && !HasFailure(); ++kill) {
    const int kind = kill % kKinds;
    SCOPED_TRACE(fmt::format("kill {} of kind {}", kill, kind));
    cut_off([&] {
      const pid_t helper = helper_of(system->gateway().pid());
      ASSERT_GT(helper, 0);
      if (kind == kHelper || kind == kGatewayAndHelper) ::kill(helper, SIGKILL);
      if (kind == kBoth || kind == kServer) system->server().kill();
      if (kind != kHelper && kind != kServer) system->gateway().kill();
      if (kind == kServer) restart_server();
    });
    if (HasFailure()) return;
    if (kind == kBoth) system->start_server();
    if (kind != kHelper && kind != kServer) start_gateway();
    const auto cut = system->wait_ended(id);
    const std::string state = cut.value("state", "");
    if (kind == kServer) {
      EXPECT_EQ(state, "completed") << "the run continues without the server";
      EXPECT_NEAR(x(), kMoves, 1e-6);
    }
    if (state == "completed") continue;
    const auto executed = cut.value("executed", std::size_t{0});
    if (kind == kHelper) {
      EXPECT_EQ(state, "alarmed") << cut.dump();
      EXPECT_LE(executed, truth) << cut.dump();
      EXPECT_GE(executed + 1, truth) << cut.dump();
      turn_on("unlock");
    } else {
      EXPECT_EQ(state, "interrupted") << cut.dump();
      EXPECT_EQ(executed, truth) << cut.dump();
    }
    restart(cut);
  }
}

/// LinuxCNC has lost where its axes are, and has to be started and homed again: the operator is
/// asked.
TEST_F(LinuxCncKill, OfItsTaskStopsTheAxesAndAsksForTheBlock) {
  for (int kill = 0; kill < (kills() + 9) / 10 && !HasFailure(); ++kill) {
    SCOPED_TRACE(kill);
    cut_off([&] { linuxcnc->kill("milltask"); });
    if (HasFailure()) return;
    const auto cut = system->wait_ended(id);
    if (cut.value("state", "") == "completed") continue;
    EXPECT_EQ(cut.value("state", ""), "alarmed") << cut.dump();
    EXPECT_LE(cut.value("executed", std::size_t{0}), truth) << cut.dump();
    EXPECT_GE(cut.value("executed", std::size_t{0}) + 1, truth) << cut.dump();
    linuxcnc->stop();
    linuxcnc->start();
    turn_on("home");
    std::string text;
    ASSERT_TRUE(eventually([&] {
      text = system->rest().post("/api/v1/runs/" + id + "/restart", nlohmann::json::object()).body;
      return text.find("look at the part and name the block") != std::string::npos;
    })) << text;
    // Its motors begin at 0 again; this path has no height to be led across at, so that they are
    // brought to the place. The interrupted block is cut from its beginning.
    std::string keyed_in;
    ASSERT_TRUE(eventually([&] {
      const auto mdi =
          system->rest().post("/api/v1/machines/lathe-1/mdi",
                              {{"text", fmt::format("G21 G90 G1 X{} F2400\n", truth - 1)}});
      text = mdi.body;
      if (mdi.status == 201) keyed_in = mdi.json().value("id", "");
      return mdi.status == 201;  // LinuxCNC may still obey the command before
    })) << text;
    EXPECT_EQ(system->wait_ended(keyed_in).value("state", ""), "completed");
    ASSERT_TRUE(rests());
    restart(cut, "block=" + std::to_string(truth + 1));
  }
}

}  // namespace
}  // namespace dripline::integration
