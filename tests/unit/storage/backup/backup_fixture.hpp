#pragma once

#include <gtest/gtest.h>
#include <fstream>

#include "storage/backup/backup_folder.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::backup {

/// A store with programs, and a folder of backups beside it.
class BackupTest : public storage::StoreTest {
 protected:
  static bool proceed(Phase, std::uint64_t, std::uint64_t) { return true; }

  Source source() {
    return {.folder = directory_.path(),
            .database = "store.sqlite",
            .files = {"token", "missing"},
            .made_by = "dncd test",
            .copy = [this](const std::filesystem::path& copy, const auto& proceed) {
              return store_->copy_to(copy, proceed);
            }};
  }
  std::filesystem::path path() { return directory_ / "backups"; }
  BackupFolder open() {
    auto folder = BackupFolder::open(path());
    EXPECT_TRUE(folder) << folder.error().what;
    return *std::move(folder);
  }
  /// Each a second after the other.
  Result<Backup> make(BackupFolder& folder, const Watch& watch = proceed) {
    clock_.advance(std::chrono::seconds(1));
    return folder.make(source(), clock_.now(), watch);
  }
  std::vector<std::filesystem::path> chunks() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path() / "chunks"))
      if (entry.is_regular_file()) files.push_back(entry.path());
    return files;
  }
  void write(const std::filesystem::path& file, std::string_view text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  /// The program's bytes in a restored folder.
  std::string restored_text(const std::filesystem::path& folder, const Digest& content) {
    auto store = storage::SqliteStore::open({.file = folder / "store.sqlite"}, clock_);
    if (!store) return store.error().what;
    const auto bytes = (*store)->programs.read_content(content, 0, 1 << 24);
    return bytes ? storage::text_of(*bytes) : bytes.error().what;
  }
};

}  // namespace dripline::backup
