// Backups of a server at work: what is restored is what was there, whatever is killed meanwhile.
// DRIPLINE_KILLS changes how often (20 by default).
#include <gtest/gtest.h>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;

constexpr std::uint64_t kLines = 500;

std::string report_program(std::uint64_t lines) {
  std::string text;
  test_support::write_report_program(lines, 3, [&](std::string_view piece) { text += piece; });
  return text;
}

std::string first_line(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

class BackupOfAServer : public testing::Test {
 protected:
  BackupOfAServer() {
    for (const std::string& argument : {std::string("--backups"), backups().string(),
                                        std::string("--backup-every-hours"), std::string("0")})
      system.add_server_argument(argument);
    system.start_server();
    system.start_gateway();
    system.wait_connected();
    system.push("O0300", report_program(kLines));
  }
  std::filesystem::path backups() const { return system.folder() / "backups"; }

  json state() const { return system.rest().get("/api/v1/backups").json(); }
  /// Waits until nothing is in progress; the outcome.
  json ended() const {
    json now;
    EXPECT_TRUE(eventually([&] {
      now = state();
      return now.is_object() && now["work"].is_null() && !now["last"].is_null();
    }));
    return now;
  }
  void back_up() const {
    EXPECT_EQ(system.rest().post("/api/v1/backups", json::object()).status, 202);
    const json now = ended();
    EXPECT_EQ(now["last"].value("error", "none"), "") << now;
  }
  /// The server is gone with its disk; another one takes its place.
  void restore_newest() {
    system.server().kill();
    std::filesystem::rename(system.server_state(), system.folder() / "lost");
    const auto restored =
        test_support::run_to_end({program_path("dncd"), "--backups", backups(), "--restore",
                                  "newest", "--state", system.server_state()},
                                 system.folder() / "restore.out");
    EXPECT_EQ(restored.status, 0) << restored.output;
    system.start_server();
  }
  void expect_whole_run() {
    const std::string id = system.start_run("O0300");
    EXPECT_EQ(system.wait_ended(id).value("state", ""), "completed");
    EXPECT_EQ(system.report_lines(id).size(), kLines);
  }

  System system;
};

TEST_F(BackupOfAServer, BringsTheShopBackOnAnotherDisk) {
  const std::string before = system.start_run("O0300");
  EXPECT_EQ(system.wait_ended(before).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return system.report_lines(before).size() == kLines; }));
  back_up();
  const std::string after = system.start_run("O0300");
  EXPECT_EQ(system.wait_ended(after).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return system.report_lines(after).size() == kLines; }));

  restore_newest();
  // The gateway was never stopped. It has already delivered, and forgotten, records that the
  // backup does not hold.
  system.wait_connected();
  EXPECT_EQ(system.report_lines(before).size(), kLines);
  EXPECT_EQ(system.rest().get("/api/v1/runs/" + after).status, 404) << "made after the backup";
  expect_whole_run();
  const auto waiting = [&] {
    return system.rest().get("/api/v1/machines/lathe-1").json()["status"].value("outbox", 99u);
  };
  EXPECT_TRUE(eventually([&] { return waiting() == 0; })) << waiting();
}

/// What was released before the loss still runs, and the key stays its owner's alone.
TEST_F(BackupOfAServer, KeepsTheKeyThatDecisionsAreSignedWith) {
  const auto key = [&] { return system.server_state() / "signing.key"; };
  const std::string seed = first_line(key());
  const auto revision = "/api/v1/programs/O0300/revisions/1/";
  for (const std::string step : {"submit", "approve", "release"})
    EXPECT_EQ(system.rest().post(revision + step, json::object()).status, 200) << step;
  back_up();
  const auto policy = system.folder() / "policy.toml";
  std::ofstream(policy) << "runs = \"release\"\n";
  system.add_server_argument("--policy");
  system.add_server_argument(policy.string());
  restore_newest();
  EXPECT_EQ(first_line(key()), seed);
  using enum std::filesystem::perms;
  EXPECT_EQ(std::filesystem::status(key()).permissions(), owner_read | owner_write);
  system.wait_connected();
  const json run = system.wait_ended(system.start_run("O0300"));
  EXPECT_EQ(run["allowed_as"], "released");
  EXPECT_EQ(run["approval"], 3);
}

TEST_F(BackupOfAServer, IsMadeWhileARunGoesOn) {
  const std::string id = system.start_run("O0300");
  for (int i = 0; i < 3; ++i) {
    back_up();
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a name a second
  }
  EXPECT_EQ(system.wait_ended(id).value("state", ""), "completed");
  EXPECT_EQ(system.report_lines(id).size(), kLines);
}

TEST_F(BackupOfAServer, KilledAtRandomMomentsLeavesGoodOnesAlone) {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 20;
  std::mt19937 random(11);
  for (int i = 0; i < kills && !HasFailure(); ++i) {
    system.push("P" + std::to_string(i), report_program(2000 + static_cast<std::uint64_t>(i)));
    EXPECT_EQ(system.rest().post("/api/v1/backups", json::object()).status, 202);
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<>(0, 150'000)(random)));
    system.server().kill();
    system.start_server();
    const json backups = state()["backups"];
    for (const auto& backup : backups) {
      if (!backup["verified"].is_null()) continue;
      const std::string id = backup["id"];
      EXPECT_EQ(system.rest().post("/api/v1/backups/" + id + "/verify", json::object()).status,
                202);
      const json now = ended();
      EXPECT_EQ(now["last"].value("error", "none"), "") << now;
    }
    EXPECT_EQ(state()["damaged"], json::array());
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  back_up();
  restore_newest();
  const auto programs = system.rest().get("/api/v1/programs?limit=1000").json()["programs"];
  EXPECT_EQ(programs.size(), static_cast<std::size_t>(kills) + 1);
}

}  // namespace
}  // namespace dripline::integration
