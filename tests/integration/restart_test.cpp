// A run that is cut off by killing its gateway, continued by `dnc run restart`: real programs, text
// from a real server by position. DRIPLINE_RESTART_KILLS changes how often.
#include <gtest/gtest.h>
#include <cstdlib>
#include <random>
#include <regex>
#include <thread>

#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;

constexpr std::uint64_t kLines = 2000;

int kills() {
  const char* wanted = std::getenv("DRIPLINE_RESTART_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 2;
}

class Restarted : public testing::Test {
 protected:
  Restarted() : system(System::Options{"2000x", {}, {}}) {
    system.start_server();
    system.start_gateway();
    system.wait_connected();
    std::string text;
    test_support::write_report_program(kLines, 3, [&](std::string_view piece) { text += piece; });
    system.push("O0300", text);
  }
  test_support::Finished dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system.server_state()});
    return test_support::run_to_end(arguments, system.folder() / "dnc.out");
  }
  void kill_gateway() {
    system.gateway().kill();
    system.start_gateway();
    system.wait_connected();
  }

  /// A simulated machine that is started again is at its start. What the operator does whose tool
  /// is somewhere else: the refusal names the place.
  void bring_tool(const std::string& refusal) {
    const std::regex place("from there to (X[-0-9.]+ Z[-0-9.]+), where the program continues");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(refusal, found, place)) << refusal;
    const auto moved = dnc({"machine", "mdi", "lathe-1", "G21 G0 " + found.str(1), "--wait"});
    ASSERT_EQ(moved.status, 0) << moved.output;
  }
  test_support::Finished restart(const std::string& id) {
    const auto shown = dnc({"run", "restart", id, "--json"});
    if (shown.status == 0) return shown;
    bring_tool(shown.output);
    return dnc({"run", "restart", id, "--json"});
  }

  System system;
  std::mt19937 random{20261123};
};

TEST_F(Restarted, ReportsEveryLineOnceOverBothRuns) {
  int done = 0;
  for (int tries = 0; done < kills() && tries < 10 * kills() && !HasFailure(); ++tries) {
    const std::string id = system.start_run("O0300");
    const std::uint64_t wanted = std::uniform_int_distribution<std::uint64_t>(1, 7000)(random);
    ASSERT_TRUE(eventually([&] { return system.execution_probe().blocks_done > wanted; }));
    kill_gateway();
    const auto cut = system.wait_ended(id);
    if (cut.value("state", "") != "interrupted") continue;
    const auto before = system.report_lines(id);
    const auto shown = restart(id);
    ASSERT_EQ(shown.status, 0) << shown.output;
    const auto report = nlohmann::json::parse(shown.output);
    EXPECT_EQ(report["restart"]["after"]["block"], cut["executed"]);
    EXPECT_EQ(report["restart"]["proof"]["path"], "equal");
    const std::string second = report["run"]["id"];
    EXPECT_EQ(system.report_lines(second).size(), 0u) << "nothing is executed before cycle start";
    const auto resumed = dnc({"run", "resume", second});
    ASSERT_EQ(resumed.status, 0) << resumed.output;
    const auto whole = system.wait_ended(second);
    EXPECT_EQ(whole.value("state", ""), "completed") << whole.dump();
    auto lines = before;
    for (const auto& line : system.report_lines(second)) lines.push_back(line);
    ASSERT_EQ(lines.size(), kLines);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      char expected[32];
      std::snprintf(expected, sizeof expected, "LINE %05zu", i + 1);
      ASSERT_EQ(lines[i], expected);
    }
    ++done;
  }
  EXPECT_EQ(done, kills());
}

TEST_F(Restarted, IsRefusedAfterANewRevisionOrSetup) {
  const std::string id = system.start_run("O0300");
  ASSERT_TRUE(eventually([&] { return system.execution_probe().blocks_done > 10; }));
  kill_gateway();
  ASSERT_EQ(system.wait_ended(id).value("state", ""), "interrupted");
  system.push("O0300", "O0300\nG0 X1\nM30\n");
  const auto refused = dnc({"run", "restart", id});
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.output.find("has revision 2 since run"), std::string::npos) << refused.output;
  const auto unknown = dnc({"run", "restart", id, "--at", "nowhere else"});
  EXPECT_NE(unknown.status, 0);
  EXPECT_NE(unknown.output.find("expected executed, block=1234"), std::string::npos)
      << unknown.output;
  ASSERT_LT(system.rest().remove("/api/v1/programs/O0300").status, 300);
  const auto removed = dnc({"run", "restart", id});
  EXPECT_NE(removed.status, 0);
  EXPECT_NE(removed.output.find("O0300"), std::string::npos) << removed.output;
}

}  // namespace
}  // namespace dripline::integration
