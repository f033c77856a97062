// HD-069: where a random tool changer has put the tools comes back with the run, and goes out with
// the next one.
#include <gtest/gtest.h>
#include <fstream>

#include "tests/integration/system.hpp"
#include "tests/support/child_process.hpp"

namespace dripline::integration {
namespace {

using test_support::Finished;
using Lines = std::vector<std::string>;

constexpr const char* kMachine = "mill-3";

const std::string kSetup = R"([control]
central_tool_file = true
random_changer = true
magazine_pockets = 12
[[tool]]
number = 1
radius = 2.0
pocket = 4       # the long one
[[tool]]
number = 2
radius = 5.0
pocket = 9
)";

std::string program(const Lines& blocks) {
  std::string text = "0 BEGIN PGM 7 MM\n";
  std::size_t number = 1;
  for (const auto& block : blocks) text += std::to_string(number++) + " " + block + "\n";
  return text + std::to_string(number) + " END PGM 7 MM\n";
}

class Changer : public testing::Test {
 protected:
  Changer() : system(options()) {
    system.start_server();
    system.start_gateway(kMachine);
    system.wait_connected(kMachine);
    std::ofstream(system.folder() / "store.toml", std::ios::binary) << kSetup;
    EXPECT_EQ(dnc({"setup", "push", kMachine, system.folder() / "store.toml"}).status, 0);
  }
  static System::Options options() {
    System::Options tnc;
    tnc.control = "tnc155";
    return tnc;
  }
  Finished dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system.server_state()});
    return test_support::run_to_end(arguments, system.folder() / "dnc.out");
  }
  std::string run(const Lines& blocks) {
    system.push("7.h", program(blocks));
    const std::string id = system.start_run("7.h", kMachine);
    EXPECT_EQ(system.wait_ended(id).at("state"), "completed");
    return id;
  }
  std::string setup() { return dnc({"setup", "pull", kMachine}).output; }
  static std::string with_pockets(const std::string& first, const std::string& second) {
    std::string text = kSetup;
    text.replace(text.find("pocket = 9"), 10, "pocket = " + second);
    return text.replace(text.find("pocket = 4"), 10, "pocket = " + first);
  }
  System system;
};

TEST_F(Changer, ItsPocketsGoFromRunToRun) {
  const auto first = run({"TOOL CALL 1 Z S100", "TOOL CALL 2 Z S100"});
  EXPECT_EQ(system.report_lines(first), (Lines{"T1 P0", "T1 P9", "T2 P0", "T1 P9", "T2 P0"}));
  const auto taken = dnc({"setup", "pockets", kMachine});
  EXPECT_EQ(taken.status, 0) << taken.output;
  EXPECT_TRUE(taken.output.starts_with("Saved setup 2 of mill-3")) << taken.output;
  EXPECT_EQ(setup(), with_pockets("9", "0"));
  const auto twice = dnc({"setup", "pockets", kMachine});
  EXPECT_EQ(twice.status, 1) << "they are taken over once";
  EXPECT_NE(twice.output.find("began with setup 1, and 2 is the newest"), std::string::npos)
      << twice.output;

  const auto second = run({"TOOL CALL 1 Z S100"});
  EXPECT_EQ(system.report_lines(second), (Lines{"T2 P9", "T1 P0", "T1 P0", "T2 P9"}))
      << "2 was in the spindle";
  EXPECT_EQ(dnc({"setup", "pockets", kMachine}).status, 0);
  EXPECT_EQ(setup(), with_pockets("0", "9"));
  const auto idle = run({"TOOL CALL 1 Z S100"});
  EXPECT_EQ(system.report_lines(idle), (Lines{"T1 P0", "T2 P9"}));
  const auto same = dnc({"setup", "pockets", kMachine});
  EXPECT_EQ(same.status, 0);
  EXPECT_EQ(same.output, "Setup 3 of mill-3 is the same already\n");
}

TEST_F(Changer, ItsPocketsOutliveAGatewayThatIsKilled) {
  system.push("7.h", program({"TOOL CALL 1 Z S100", "STOP", "TOOL CALL 2 Z S100"}));
  const std::string id = system.start_run("7.h", kMachine);
  ASSERT_TRUE(test_support::eventually([&] { return system.report_lines(id).size() == 1; }));
  const auto busy = dnc({"setup", "pockets", kMachine});
  EXPECT_EQ(busy.status, 1);
  EXPECT_NE(busy.output.find("its pockets are known when it has ended"), std::string::npos)
      << busy.output;
  system.gateway().kill();
  system.start_gateway(kMachine);
  EXPECT_EQ(system.wait_ended(id).at("state"), "interrupted");
  EXPECT_EQ(dnc({"setup", "pockets", kMachine}).status, 0);
  EXPECT_EQ(setup(), with_pockets("0", "9"));
}

}  // namespace
}  // namespace dripline::integration
