// A hot folder on a share that does not answer: shown, and no server waits for it at its end.
#include <gtest/gtest.h>
#include <csignal>
#include <sstream>

#include "tests/integration/system.hpp"
#include "tests/support/hung_folder.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;

TEST(HungFolder, IsShownAndTheServerEndsWithoutItAndTakesItsFileOnce) {
  if (!test_support::kCanPreload) GTEST_SKIP() << "a sanitizer must be loaded first";
  const test_support::HungFolder hung(DRIPLINE_HUNG_FOLDER);
  System system;
  system.add_server_argument(hung.argument());
  system.start_server();
  hung.post("O0200.nc");
  const auto list = [&] {
    return test_support::run_to_end(
        {program_path("dnc"), "--state", system.server_state(), "folder", "list"},
        system.folder() / "dnc.out");
  };
  const auto health = [&] { return system.rest().get("/api/v1/server").body; };
  ASSERT_TRUE(eventually([&] {
    return health().find("has not answered for") != std::string::npos;
  })) << health();
  EXPECT_EQ(system.rest().get("/api/v1/health").json().value("status", ""), "degraded");
  EXPECT_NE(health().find("folder=cam: "), std::string::npos) << health();
  const auto shown = list();
  EXPECT_NE(shown.output.find("has not answered for"), std::string::npos) << shown.output;
  system.server().signal(SIGTERM);
  EXPECT_EQ(system.server().wait(std::chrono::seconds(50)), 1) << "an end that is not a whole one";
  std::stringstream log;
  log << std::ifstream(system.folder() / "dncd.log").rdbuf();
  EXPECT_NE(log.str().find("hot folder cam does not answer"), std::string::npos) << log.str();
  hung.answer();
  system.start_server();
  EXPECT_TRUE(eventually([&] { return std::filesystem::exists(hung.path() / "done/O0200.nc"); }));
  EXPECT_EQ(system.rest().get("/api/v1/programs/O0200").json()["revisions"].size(), 1u);
  EXPECT_EQ(list().output.find("has not answered"), std::string::npos);
}

}  // namespace
}  // namespace dripline::integration
