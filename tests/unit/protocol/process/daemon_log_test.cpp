#include "protocol/process/daemon_log.hpp"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/temporary_folder.hpp"

namespace dripline::process {
namespace {

class DaemonLog : public testing::Test {
 protected:
  ~DaemonLog() override { spdlog::set_default_logger(before_); }

  std::filesystem::path file() const { return folder_.path() / "d.log"; }
  LogOptions options() const {
    return {.file = file().string(), .level = "info", .max_mb = 1, .kept = 2};
  }
  static std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  const std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
  test_support::TemporaryFolder folder_;
};

TEST_F(DaemonLog, NeverTakesMoreThanItsFiles) {
  ASSERT_TRUE(start_log("d", options()));
  const std::string line(10'000, 'x');
  for (int i = 0; i < 1000; ++i) spdlog::info("{} {}", i, line);
  std::uintmax_t size = 0;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    size += entry.file_size();
    ++files;
  }
  EXPECT_EQ(files, 3u);
  EXPECT_LE(size, 3u * 1024 * 1024);
  EXPECT_NE((text_of(file()) + text_of(folder_.path() / "d.1.log")).find(" 999 "),
            std::string::npos);
}

TEST_F(DaemonLog, ReopensItsFileWhenItWasMovedAway) {
  ASSERT_TRUE(start_log("d", options()));
  spdlog::info("first");
  std::filesystem::rename(file(), folder_.path() / "moved");
  EXPECT_TRUE(reopen_log());
  spdlog::info("sec\nond");
  EXPECT_NE(text_of(folder_.path() / "moved").find("first"), std::string::npos);
  EXPECT_NE(text_of(file()).find(" info sec\\nond\n"), std::string::npos) << text_of(file());
}

TEST_F(DaemonLog, HasNoFileToOpenOnStandardError) {
  ASSERT_TRUE(start_log("d", {}));
  EXPECT_FALSE(reopen_log());
}

TEST_F(DaemonLog, BoundsTheMessagesOfALibrary) {
  ASSERT_TRUE(start_log("d", options()));
  for (int i = 0; i < 100'000; ++i) log_foreign(false, "malformed packet");
  const std::string text = text_of(file());
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GE(lines, 10);
  EXPECT_LE(lines, 200);  // ten in ten seconds, however slow this machine is
}

}  // namespace
}  // namespace dripline::process
