// Promises 1 and 2: nothing is lost or doubled and the executed counter is right, whatever is
// killed, at whatever moment. DRIPLINE_KILLS changes how often (40 by default).
#include <gtest/gtest.h>
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kLines = 2000;
constexpr milliseconds kLongestWait{600};  // before a kill; a whole run where the disk is quick

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 40;
}

std::string report_program(std::uint64_t lines) {
  std::string text;
  test_support::write_report_program(lines, 3, [&](std::string_view piece) { text += piece; });
  return text;
}

void expect_lines_in_order(const std::vector<std::string>& lines, const std::string& run) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    char expected[32];
    std::snprintf(expected, sizeof expected, "LINE %05zu", i + 1);
    ASSERT_EQ(lines[i], expected) << "run " << run;
  }
}

class Kill : public testing::Test {
 protected:
  void begin(const std::string& speed) {
    system.emplace(System::Options{speed, {}, {}});
    system->start_server();
    system->start_gateway();
    system->wait_connected();
    system->push("O0300", report_program(kLines));
    const auto start = std::chrono::steady_clock::now();
    const std::string id = system->start_run("O0300");
    EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed");
    const auto took =
        std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - start);
    run_ms = static_cast<int>(std::clamp(took, milliseconds(20), kLongestWait).count());
  }

  /// The moment of a kill is the test's subject, so here it does sleep.
  void wait_a_random_time(int up_to_ms) {
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<>(0, up_to_ms * 1000)(random)));
  }

  /// A run cut off by killing the gateway: completed, or interrupted exactly where the machine was.
  void expect_right_ending(const std::string& id, const System::ExecutionProbe& truth) {
    const auto run = system->wait_ended(id);
    const auto lines = system->report_lines(id);
    expect_lines_in_order(lines, id);
    if (run.value("state", "") == "completed") {
      EXPECT_EQ(lines.size(), kLines);
    } else {
      EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
      const auto executed = run.value("executed", std::uint64_t{0});
      EXPECT_GE(executed, truth.blocks_done) << run.dump();
      EXPECT_LE(executed, truth.blocks_begun) << run.dump();
      EXPECT_GE(lines.size(), truth.outputs_done) << run.dump();
      EXPECT_LE(lines.size(), truth.outputs_begun) << run.dump();
      ++interrupted;
    }
  }

  std::optional<System> system;
  std::mt19937 random{20261121};
  int run_ms = 0;
  int interrupted = 0;
};

TEST_F(Kill, TheGatewayAtRandomMoments) {
  begin("max");
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    const std::string id = system->start_run("O0300");
    wait_a_random_time(run_ms);
    system->gateway().kill();
    const auto truth = system->execution_probe();
    system->start_gateway();
    expect_right_ending(id, truth);
    system->wait_connected();
  }
  EXPECT_GT(interrupted, kills() / 4) << "the kills must hit running programs";
}

TEST_F(Kill, BothAtRandomMoments) {
  begin("max");
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    const std::string id = system->start_run("O0300");
    wait_a_random_time(run_ms);
    (i % 2 == 0 ? system->gateway() : system->server()).kill();
    wait_a_random_time(5);
    system->server().kill();
    system->gateway().kill();
    const auto truth = system->execution_probe();
    system->start_server();
    system->start_gateway();
    expect_right_ending(id, truth);
    system->wait_connected();
  }
  EXPECT_GT(interrupted, kills() / 4) << "the kills must hit running programs";
}

TEST_F(Kill, TheServerAtRandomMomentsWhileRunsGoOn) {
  begin("max");
  std::string id = system->start_run("O0300");
  int completed = 0;
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    wait_a_random_time(100);
    system->server().kill();
    system->start_server();
    if (system->run(id).value("state", "") == "active") continue;
    const auto run = system->wait_ended(id);
    EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
    expect_lines_in_order(system->report_lines(id), id);
    EXPECT_EQ(system->report_lines(id).size(), kLines);
    ++completed;
    system->wait_connected();
    id = system->start_run("O0300");
  }
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed");
  expect_lines_in_order(system->report_lines(id), id);
  EXPECT_EQ(system->report_lines(id).size(), kLines);
}

TEST_F(Kill, TheLinkIsCutAtRandomMoments) {
  begin("max");
  std::string id = system->start_run("O0300");
  for (int i = 0; i < kills() && !HasFailure(); ++i) {
    wait_a_random_time(100);
    system->server().signal(
        SIGSTOP);  // a peer that no longer answers; every tenth for longer than its lease
    wait_a_random_time(i % 10 == 9 ? 2500 : 250);
    system->server().signal(SIGCONT);
    if (system->run(id).value("state", "") == "active") continue;
    EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed");
    expect_lines_in_order(system->report_lines(id), id);
    EXPECT_EQ(system->report_lines(id).size(), kLines);
    system->wait_connected();
    id = system->start_run("O0300");
  }
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed");
  EXPECT_EQ(system->report_lines(id).size(), kLines);
}

}  // namespace
}  // namespace dripline::integration
