#include "server/folders/folder_watch.hpp"

#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <fstream>
#include <functional>
#include <future>

#include "server/folders/folders.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::folders {
namespace {

namespace fs = std::filesystem;

TEST(FolderEvents, TellWhatIsWrittenAndWhatIsWhole) {
  const test_support::TemporaryFolder folder;
  FolderWatch::Events events;
  Arrivals arrivals;
  events.watch(folder.path());
  events.watch(folder.path());
  EXPECT_FALSE(events.read(arrivals));
  {
    std::ofstream file(folder.path() / "a.nc");
    file << "O1\n" << std::flush;
    EXPECT_TRUE(events.read(arrivals));
    EXPECT_TRUE(arrivals.written.contains("a.nc"));
  }
  EXPECT_TRUE(events.read(arrivals));
  EXPECT_TRUE(arrivals.written.empty()) << "it is closed";
  EXPECT_TRUE(arrivals.whole.empty()) << "it may be opened again";
  fs::rename(folder.path() / "a.nc", folder.path() / "b.nc");
  EXPECT_TRUE(events.read(arrivals));
  EXPECT_EQ(arrivals.whole, std::set<std::string>{"b.nc"});
}

class FoldersTest : public server_test::ServerTest {
 protected:
  FoldersTest() {
    catalog_.known.push_back("fanuc");
    settings_.name = "cam";
    settings_.path = folder_.path() / "cam";
    settings_.control = "fanuc";
    settings_.unchanged_time = std::chrono::milliseconds(0);
    settings_.poll = std::chrono::seconds(3600);
    fs::create_directories(settings_.path);
  }
  void begin(std::function<void(const storage::FolderFile&)> on_file = {}) {
    folders_ = std::make_unique<Folders>(
        HotFolder::Parts{.programs = *programs_,
                         .catalog = catalog_,
                         .sources = {.store = *store_, .releases = *releases_, .clock = real_},
                         .spool = folder_.path(),
                         .on_file = std::move(on_file)},
        std::vector{settings_});
    folders_->begin();
  }
  bool has_looked() { return folders_->states().at(0).looked.has_value(); }

  SystemClock real_;
  FolderSettings settings_;
  std::unique_ptr<Folders> folders_;
};

TEST_F(FoldersTest, AreWokenByTheSystemAndEndAtOnce) {
  begin();
  ASSERT_TRUE(test_support::eventually([&] { return has_looked(); }));
  std::ofstream(settings_.path / "O0200.nc") << "O200\nM30\n";
  EXPECT_TRUE(test_support::eventually([&] {
    return fs::exists(settings_.path / "done/O0200.nc");
  })) << "the next look without an event is in an hour";
  EXPECT_EQ(folders_->files("cam", {})->at(0).program, "O0200");
  EXPECT_EQ(folders_->files("other", {}).error().code, Errc::NotFound);
  const auto begun = std::chrono::steady_clock::now();
  folders_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
}

/// A thread in the kernel that waits for a share cannot be ended; this one waits for the test.
TEST_F(FoldersTest, OneThatDoesNotEndIsNamedAndNotWaitedForLonger) {
  std::promise<void> taken, answered;
  begin([&](const storage::FolderFile&) {
    taken.set_value();
    answered.get_future().wait();
  });
  std::ofstream(settings_.path / "O0200.nc") << "O200\nM30\n";
  ASSERT_EQ(taken.get_future().wait_for(test_support::kPatience), std::future_status::ready);
  folders_->request_end();
  const auto ended = folders_->end(std::chrono::steady_clock::now());
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().what, "hot folder cam does not answer");
  answered.set_value();
  EXPECT_TRUE(folders_->end(std::chrono::steady_clock::now() + test_support::kPatience));
}

}  // namespace
}  // namespace dripline::folders
