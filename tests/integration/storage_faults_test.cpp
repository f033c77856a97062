// What the server does when its disk is full or its database damaged.
#include <gtest/gtest.h>
#include <cstdlib>
#include <fstream>

#include "tests/integration/small_disk.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

std::string report_program(std::uint64_t lines) {
  std::string text;
  test_support::write_report_program(lines, 3, [&](std::string_view piece) { text += piece; });
  return text;
}

TEST(FullDisk, TheGatewayKeepsItsRecordsAndDeliversThemLater) {
  System system({.speed = "max", .server_arguments = {}, .gateway_arguments = {}});
  SmallDisk disk(system.server_state());
  if (!disk.is_mounted()) GTEST_SKIP() << "mounting a tmpfs needs root";
  system.start_server();
  system.start_gateway();
  system.wait_connected();
  system.push("O0300", report_program(2000));
  const std::string id = system.start_run("O0300");
  disk.fill();
  const auto waiting = [&] {
    return system.rest().get("/api/v1/machines/lathe-1").json()["status"].value("outbox", 0u);
  };
  EXPECT_TRUE(test_support::eventually([&] { return waiting() >= 1900; })) << waiting();
  EXPECT_EQ(system.run(id).value("state", ""), "active");
  disk.empty();
  EXPECT_EQ(system.wait_ended(id).value("state", ""), "completed");
  const auto lines = system.report_lines(id);
  ASSERT_EQ(lines.size(), 2000u);
  EXPECT_EQ(lines.front(), "LINE 00001");
  EXPECT_EQ(lines.back(), "LINE 02000");
}

/// A full disk may keep dncd.json from being written, and nothing else has to fail for it.
TEST(FullDisk, TheServerWorksWithoutItsAnnouncementAndMakesItLater) {
  System system;
  const auto in_the_way = system.server_state() / "dncd.json.new";
  std::filesystem::create_directories(in_the_way / "full");
  std::filesystem::permissions(system.server_state(), std::filesystem::perms::owner_all);
  system.launch_server();
  EXPECT_TRUE(test_support::eventually(
      [&] { return system.server().output().find("dncd listening at") != std::string::npos; }));
  EXPECT_FALSE(std::filesystem::exists(system.server_state() / "dncd.json"));
  std::filesystem::remove_all(in_the_way);
  EXPECT_TRUE(test_support::eventually([&] {
    return std::filesystem::exists(system.server_state() / "dncd.json") &&
           system.rest().get("/api/v1/server").status == 200;
  }));
}

/// Flips one byte in the middle of the first stored chunk, through SQLite, so that the database
/// itself stays well-formed.
void damage_first_chunk(const std::filesystem::path& database, const std::filesystem::path& log) {
  const std::string sql =
      "UPDATE chunk SET data = CAST(substr(data,1,length(data)/2-1) || x'00' || "
      "substr(data,length(data)/2+1) AS BLOB) "
      "WHERE rowid = (SELECT min(rowid) FROM chunk);";
  const auto done = test_support::run_to_end({"/usr/bin/sqlite3", database, sql}, log);
  ASSERT_EQ(done.status, 0) << done.output;
}

TEST(DamagedDatabase, ACorruptedChunkIsRefusedAndNeverExecuted) {
  System system;
  system.start_server();
  system.push("O0300", report_program(10));
  system.server().signal(SIGTERM);
  ASSERT_EQ(system.server().wait(), 0);
  damage_first_chunk(system.server_state() / "dripline.sqlite", system.folder() / "sqlite.out");

  system.start_server();
  system.start_gateway();
  system.wait_connected();
  const auto reply =
      system.rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
  const auto run = reply.status == 201 ? system.wait_ended(reply.json().value("id", ""))
                                       : nlohmann::json::object();
  const std::string reason = reply.status == 201 ? run.value("reason", "") : reply.body;
  EXPECT_NE(reason.find("orrupt"), std::string::npos) << reply.body << run.dump();
  EXPECT_NE(run.value("state", ""), "completed");
  EXPECT_EQ(run.value("executed", 0u), 0u);
  EXPECT_NE(system.rest().get("/api/v1/programs/O0300/content").body.size(),
            report_program(10).size());
}

}  // namespace
}  // namespace dripline::integration
