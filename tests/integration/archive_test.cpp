// Archives of a server at work: read back without it, watched by it, and proved by its audit trail.
#include <gtest/gtest.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;

/// A run of 1,200 lines; all records but the newest thousand are in an archive.
class ArchivesOfAServer : public testing::Test {
 protected:
  ArchivesOfAServer() {
    for (const std::string& argument :
         {std::string("--archives"), folder().string(), std::string("--archive-records-thousands"),
          std::string("1")})
      system.add_server_argument(argument);
    system.start_server();
    system.start_gateway();
    system.wait_connected();
    std::string text;
    test_support::write_report_program(1200, 3, [&](std::string_view piece) { text += piece; });
    system.push("O0300", text);
    run = system.start_run("O0300");
    EXPECT_EQ(system.wait_ended(run)["state"], "completed");
    lines = system.report_lines(run);
    EXPECT_EQ(dnc("server archive").status, 0);
    const json list = system.rest().get("/api/v1/archives").json();
    EXPECT_EQ(list["archives"].size(), 1u) << list;
    name = list["archives"].empty() ? "" : list["archives"][0]["file"].get<std::string>();
  }
  std::filesystem::path folder() const { return system.folder() / "archives"; }
  std::filesystem::path file() const { return folder() / name; }
  test_support::Finished dnc(const std::string& arguments) const {
    const std::string command = program_path("dnc") + " --state " + system.server_state().string() +
                                " " + arguments + " 2>&1";
    return test_support::run_to_end({"/bin/sh", "-c", command}, system.folder() / "dnc.out");
  }
  json health() const { return system.rest().get("/api/v1/health").json(); }
  void expect_named(const std::string& what) const {
    const auto verified = dnc("audit verify");
    EXPECT_EQ(verified.status, 1) << verified.output;
    EXPECT_NE(verified.output.find("archive " + name + ": " + what), std::string::npos)
        << verified.output;
    EXPECT_TRUE(eventually([&] {
      return health()["reasons"].dump().find("archives") != std::string::npos;
    })) << health();
  }

  System system;
  std::string run, name;
  std::vector<std::string> lines;
};

TEST_F(ArchivesOfAServer, AreReadBackAndProved) {
  const auto shown = dnc("report show " + run + " --archive " + file().string());
  ASSERT_EQ(shown.status, 0) << shown.output;
  std::istringstream archived(shown.output);
  std::size_t count = 0;
  for (std::string line; std::getline(archived, line); ++count)
    EXPECT_EQ(line, lines.at(count)) << count;
  EXPECT_GT(count, 100u);
  const auto good = dnc("audit verify");
  EXPECT_EQ(good.status, 0) << good.output;
  EXPECT_NE(good.output.find("1 archives, each as it was written."), std::string::npos);
  EXPECT_EQ(health()["status"], "ok");
  EXPECT_EQ(dnc("audit export " + (system.folder() / "trail").string()).status, 0);
  const std::string offline =
      "audit verify " + (system.folder() / "trail").string() + " --archives " + folder().string();
  EXPECT_EQ(dnc(offline).status, 0);

  // One bit, in place.
  std::fstream bytes(file(), std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(file()) / 2);
  bytes.seekg(middle);
  const int was = bytes.get();
  bytes.seekp(middle);
  bytes.put(static_cast<char>(was ^ 1));
  bytes.close();
  const auto refused = dnc("report show " + run + " --archive " + file().string());
  EXPECT_NE(refused.status, 0);
  EXPECT_EQ(refused.output.find(lines.front()), std::string::npos) << "nothing of it is printed";
  expect_named("it was changed");
  EXPECT_EQ(dnc(offline).status, 1);
  std::filesystem::rename(file(), folder() / "away");
  expect_named("it is missing");
}

}  // namespace
}  // namespace dripline::integration
