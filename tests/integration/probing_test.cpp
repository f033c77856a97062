// A probing program and the macros it calls, fed from the library to a simulated mill: what is
// measured comes back as report lines.
#include <gtest/gtest.h>
#include <fstream>
#include <sstream>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

/// The bore is where a ball of radius 3 finds a bore of 40.031 about (80.018, 44.973).
constexpr const char* kSetup = R"(units = "mm"
start = { X = 80.0, Y = 45.0, Z = 5.0 }
[[variable]]
name = "#520"
value = 3.0
[probe]
surface = [{ cylinder = { center = { X = 80.018, Y = 44.973 }, radius = 17.0155 } }]
)";

constexpr const char* kProgram = R"(%
O0700 (MEASURE THE BORE)
G21 G90 G17
POPEN
G65 P9712 D40. Z-8. S12. H.02
PCLOS
M30
%
)";

std::string macro_text(const std::string& name) {
  std::ifstream file("deploy/macros/" + name + ".nc", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Probing, MeasuredValuesComeBackAsReportLines) {
  const test_support::TemporaryFolder folder;
  const std::string setup = folder.path() / "setup.toml";
  std::ofstream(setup) << kSetup;
  System system({.speed = "max",
                 .server_arguments = {},
                 .gateway_arguments = {"--setup", setup},
                 .control = "fanuc"});
  system.start_server();
  system.start_gateway("mill-1");
  system.wait_connected("mill-1");
  for (const char* name : {"O9712", "O9720", "O9721", "O9722"}) {
    system.push(name, macro_text(name));
  }
  system.push("O0700", kProgram);
  const std::string id = system.start_run("O0700", "mill-1");
  const auto run = system.wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  const auto lines = system.report_lines(id);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "BORE    12");
  EXPECT_EQ(lines[1], "X    12 NOM     80.000 ACT     80.018 DEV      0.018 TOL  0.020 OUT 0");
  EXPECT_EQ(lines[2], "Y    12 NOM     45.000 ACT     44.973 DEV -    0.027 TOL  0.020 OUT 1");
  EXPECT_EQ(lines[3], "D    12 NOM     40.000 ACT     40.031 DEV      0.031 TOL  0.020 OUT 1");
}

}  // namespace
}  // namespace dripline::integration
