#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <mutex>
#include <vector>

#include "tests/unit/storage/backup/backup_fixture.hpp"

namespace {

std::mutex sync_mutex;
std::vector<std::string> synced_paths;

/// The path by which this test's process knows the descriptor now.
std::string path_of_descriptor(int descriptor) {
  std::error_code ec;
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), ec).string();
}

}  // namespace

/// In place of the library's, for the whole program: what was made durable is noted.
extern "C" int fsync(int descriptor) {
  const std::lock_guard lock(sync_mutex);
  synced_paths.push_back(path_of_descriptor(descriptor));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

namespace dripline::backup {
namespace {

bool was_synced(const std::filesystem::path& path) {
  const std::lock_guard lock(sync_mutex);
  return std::ranges::find(synced_paths, std::filesystem::canonical(path).string()) !=
         synced_paths.end();
}

void forget_syncs() {
  const std::lock_guard lock(sync_mutex);
  synced_paths.clear();
}

TEST_F(BackupTest, HasItsNamesOnDiskWhenItIsReported) {
  ASSERT_TRUE(push("O0001", storage::nc_text(1 << 20)));
  auto folder = open();
  forget_syncs();
  const auto made = make(folder);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_TRUE(was_synced(path() / "chunks")) << "its sub-folders are names in it";

  forget_syncs();
  const auto restored = directory_ / "restored";
  ASSERT_TRUE(folder.restore(made->id, restored, proceed));
  EXPECT_TRUE(was_synced(directory_.path())) << "the restored folder is a name in it";
  const std::lock_guard lock(sync_mutex);
  const std::string fresh = std::filesystem::canonical(directory_.path()) / "restored.restoring";
  EXPECT_NE(std::ranges::find(synced_paths, fresh), synced_paths.end()) << "and its files in this";
}

}  // namespace
}  // namespace dripline::backup
