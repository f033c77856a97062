// HD-071: a program of the TNC 155 is edited while it runs.
#include <gtest/gtest.h>

#include <fstream>

#include "protocol/base/digest.hpp"
#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;

constexpr std::uint64_t kBlocks = 60'000;
constexpr std::uint64_t kStopBlock = 100;
constexpr std::uint64_t kLastMove = kBlocks - 2;

/// So long that a gateway does not hold all of it ahead of block 100, where it stops and waits.
std::string long_program() {
  const std::string blanks(80, ' ');
  std::string text =
      "0 BEGIN PGM 15 MM\r\n1 TOOL DEF 1 L+0,000 R+0,000\r\n2 TOOL CALL 1 Z S500,000\r\n";
  for (std::uint64_t number = 3; number < kBlocks; ++number) {
    text += std::to_string(number);
    if (number == kStopBlock) {
      text += " STOP M\r\n";
    } else if (number == kLastMove) {
      text += " L Z+50,000 R0 F9000 M\r\n";
    } else {
      text += (number % 2 ? " L X+1,000 " : " L X+0,000 ") + blanks + "R0 F9000 M\r\n";
    }
  }
  return text + std::to_string(kBlocks) + " END PGM 15 MM\r\n";
}

class BackgroundEditing : public testing::Test {
 protected:
  BackgroundEditing()
      : system({.speed = "max",
                .server_arguments = {},
                .gateway_arguments = {},
                .control = "tnc155"}) {
    system.start_server();
    system.start_gateway("mill-1");
    system.wait_connected("mill-1");
  }

  void dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system.server_state()});
    const auto done = test_support::run_to_end(arguments, system.folder() / "dnc.out");
    EXPECT_EQ(done.status, 0) << done.output;
  }
  nlohmann::json status() const {
    return system.rest().get("/api/v1/machines/mill-1").json()["status"];
  }
  bool comes_to_stop(const std::string& id) {
    return eventually([&] {
      const auto now = status();
      return now.value("run", nlohmann::json()) == id &&
             now.value("execution", "") == "PROGRAM_STOPPED";
    });
  }
  /// Where the last move of the program goes.
  bool stands_at(double z) {
    return eventually([&] { return status()["position"].value("Z", 0.0) == z; });
  }
  /// Resumes the run after its stop, and returns it when it has ended.
  nlohmann::json resume(const std::string& id) {
    dnc({"run", "resume", id});
    return system.wait_ended(id);
  }
  std::string setup(const std::string& control) const {
    const auto path = system.folder() / "setup.toml";
    std::ofstream(path) << "[control]\n" << control << "\n";
    return path;
  }
  System system;
};

TEST_F(BackgroundEditing, ARunKeepsItsRevisionToItsEndAndTheNextOneTakesTheEdit) {
  const std::string text = long_program();
  system.push("15.h", text);
  const std::string first = system.start_run("15.h", "mill-1");
  ASSERT_TRUE(comes_to_stop(first)) << status().dump();
  ASSERT_LT(status().value("sent", 0u), text.size()) << "the end is still to be fetched";

  dnc({"edit", "--program", "15.h", "--set", std::to_string(kLastMove), "Z+70", "--set", "3", "X+2",
       "--delete", "4..5", "--comment", "while it runs"});
  EXPECT_EQ(system.rest().get("/api/v1/programs/15.h").json().value("revision", 0), 2);
  EXPECT_EQ(status().value("execution", ""), "PROGRAM_STOPPED");
  const auto run = resume(first);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("revision", 0), 1);
  EXPECT_EQ(run.value("sha256", ""), sha256(text).hex());
  EXPECT_TRUE(run.value("content_verified", false)) << run.dump();
  EXPECT_EQ(run.value("sent", 0u), text.size());
  EXPECT_EQ(run.value("executed", 0u), kBlocks + 1);
  EXPECT_TRUE(stands_at(50)) << status().dump();

  const std::string second = system.start_run("15.h", "mill-1");
  ASSERT_TRUE(comes_to_stop(second)) << status().dump();
  const auto next = resume(second);
  EXPECT_EQ(next.value("state", ""), "completed") << next.dump();
  EXPECT_EQ(next.value("revision", 0), 2);
  EXPECT_EQ(next.value("executed", 0u), kBlocks - 1);
  EXPECT_TRUE(next.value("content_verified", false)) << next.dump();
  EXPECT_TRUE(stands_at(70)) << status().dump();
}

// HD-076, HD-081, HD-082: without a run the screen shows what playback puts into a program, and in
// which units is what the newest setup says.
TEST_F(BackgroundEditing, TakesThePositionThatTheScreenOfTheIdleControlShows) {
  const auto shown = [&] { return status()["coordinates"]["program"]; };
  ASSERT_TRUE(eventually([&] { return shown().is_object(); })) << status().dump();
  dnc({"machine", "datum", "mill-1", "X", "40", "--unit", "mm"});
  EXPECT_TRUE(eventually([&] { return shown()["position"].value("X", 0.0) == 40; }))
      << status().dump();
  system.push("15.h",
              "0 BEGIN PGM 15 MM\r\n1 TOOL CALL 0 Z S500,000\r\n2 STOP M\r\n3 END PGM 15 MM\r\n");
  dnc({"machine", "playback", "mill-1", "X", "--into", "15.h", "--after", "1"});
  EXPECT_EQ(system.rest().get("/api/v1/programs/15.h").json().value("revision", 0), 2);
  EXPECT_EQ(system.rest().get("/api/v1/programs/15.h/content").body,
            "0 BEGIN PGM 15 MM\r\n1 TOOL CALL 0 Z S500,000\r\n2 X+40,000 R0 F M\r\n3 STOP M\r\n"
            "4 END PGM 15 MM\r\n");
  EXPECT_EQ(status()["screen"].value("units", ""), "mm");
  dnc({"setup", "push", "mill-1", setup("display_units = \"inch\"\nposition_display = \"REF\"")});
  EXPECT_TRUE(eventually([&] { return status()["screen"].value("units", "") == "inch"; }))
      << status().dump();
  EXPECT_EQ(status()["screen"].value("position", ""), "reference");
}

}  // namespace
}  // namespace dripline::integration
