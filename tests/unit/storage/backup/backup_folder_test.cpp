#include "storage/backup/backup_folder.hpp"

#include <thread>

#include "tests/unit/storage/backup/backup_fixture.hpp"

namespace dripline::backup {
namespace {

using storage::nc_text;

constexpr std::size_t kMebi = 1 << 20;

TEST_F(BackupTest, IsRestoredAsTheServerWas) {
  const std::string text = nc_text(3 * kMebi);
  const auto pushed = push("O0001", text);
  ASSERT_TRUE(pushed);
  write(directory_ / "token", "secret\n");
  auto folder = open();
  const auto made = make(folder);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_GT(made->size, 0u);
  ASSERT_TRUE(push("O0002", nc_text(1000, 2)));  // not part of the backup

  const auto restored = directory_ / "restored";
  const auto done = folder.restore(made->id, restored, proceed);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_EQ(restored_text(restored, pushed->content), text);
  std::string token;
  std::getline(std::ifstream(restored / "token"), token);
  EXPECT_EQ(token, "secret");
  EXPECT_EQ(std::filesystem::status(restored).permissions(), std::filesystem::perms::owner_all);
  EXPECT_EQ(std::filesystem::status(restored / "token").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_FALSE(std::filesystem::exists(restored / "missing"));
}

TEST_F(BackupTest, CostsWhatHasChanged) {
  ASSERT_TRUE(push("O0001", nc_text(8 * kMebi)));
  auto folder = open();
  const auto first = make(folder);
  ASSERT_TRUE(first);
  const auto same = make(folder);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->size, first->size);
  EXPECT_LT(same->added, first->added / 5) << "page 1 carries a counter";
  ASSERT_TRUE(push("O0002", nc_text(kMebi, 2)));
  const auto more = make(folder);
  ASSERT_TRUE(more);
  EXPECT_GT(more->added, kMebi / 10);
  EXPECT_LT(more->added, first->added / 2);
}

TEST_F(BackupTest, IsOnePictureWhileOthersWrite) {
  auto folder = open();
  std::atomic<bool> is_over = false;
  std::jthread writer([&] {
    for (unsigned i = 0; !is_over; ++i)
      if (!push("O" + std::to_string(i), nc_text(20'000, i + 10))) return;
  });
  for (int i = 0; i < 5; ++i) {
    const auto made = make(folder);
    ASSERT_TRUE(made) << made.error().what;
    const auto restored = directory_ / ("restored-" + std::to_string(i)).c_str();
    const auto done = folder.restore(made->id, restored, proceed);
    ASSERT_TRUE(done) << done.error().what;
    // Every revision that is listed has its bytes: no half of a push.
    auto store = storage::SqliteStore::open({.file = restored / "store.sqlite"}, clock_);
    ASSERT_TRUE(store);
    const auto listed = (*store)->programs.list({});
    ASSERT_TRUE(listed);
    for (const auto& program : *listed)
      EXPECT_TRUE((*store)->programs.verify_content(program.latest.content))
          << program.latest.program;
  }
  is_over = true;
}

TEST_F(BackupTest, WhoseWorkIsEndedCountsForNothing) {
  ASSERT_TRUE(push("O0001", nc_text(4 * kMebi)));
  auto folder = open();
  for (const Phase phase : {Phase::Copying, Phase::Checking, Phase::Storing}) {
    const auto made =
        make(folder, [phase](Phase now, std::uint64_t, std::uint64_t) { return now != phase; });
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, Errc::Conflict);
    EXPECT_TRUE(folder.list()->backups.empty());
    EXPECT_FALSE(std::filesystem::exists(path() / "database.copy"));
  }
  ASSERT_TRUE(make(folder));
  const auto pruned = folder.prune({}, clock_.now());
  ASSERT_TRUE(pruned) << pruned.error().what;
  EXPECT_TRUE(folder.verify(folder.list()->backups.at(0).id, clock_.now(), proceed));
}

TEST_F(BackupTest, OfADamagedDatabaseIsNotMade) {
  ASSERT_TRUE(push("O0001", nc_text(kMebi)));
  auto folder = open();
  Source broken = source();
  broken.copy = [&](const std::filesystem::path& copy, const auto& proceed) {
    const auto copied = store_->copy_to(copy, proceed);
    std::fstream file(copy, std::ios::in | std::ios::out | std::ios::binary);
    for (const int page : {2, 3, 4, 5, 6}) {
      file.seekp(page * 4096);
      file << std::string(4096, 'x');
    }
    return copied;
  };
  const auto made = folder.make(broken, clock_.now(), proceed);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, Errc::Corrupt) << made.error().what;
  EXPECT_TRUE(folder.list()->backups.empty());
}

TEST_F(BackupTest, ThatIsDamagedIsFoundAndHealedByTheNext) {
  ASSERT_TRUE(push("O0001", nc_text(2 * kMebi)));
  auto folder = open();
  const auto first = make(folder);
  ASSERT_TRUE(first);
  ASSERT_TRUE(folder.verify(first->id, clock_.now(), proceed));
  EXPECT_EQ(folder.list()->backups.at(0).verified, clock_.now());
  const auto files = chunks();
  ASSERT_GT(files.size(), 2u);
  write(files[0], "not a chunk");
  std::filesystem::resize_file(files[1], 7);

  const auto found = folder.verify(first->id, clock_.now(), proceed);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, Errc::Corrupt);
  EXPECT_NE(found.error().what.find("2 of its chunks"), std::string::npos) << found.error().what;
  EXPECT_FALSE(folder.list()->backups.at(0).verified);
  const auto restored = folder.restore(first->id, directory_ / "restored", proceed);
  EXPECT_FALSE(restored);
  EXPECT_FALSE(std::filesystem::exists(directory_ / "restored")) << "nothing half";

  ASSERT_TRUE(make(folder));
  EXPECT_TRUE(folder.verify(folder.list()->backups.at(1).id, clock_.now(), proceed));
}

TEST_F(BackupTest, AnyChangedByteOfItIsFound) {
  ASSERT_TRUE(push("O0001", nc_text(kMebi)));
  auto folder = open();
  const auto made = make(folder);
  ASSERT_TRUE(made);
  auto files = chunks();
  files.push_back(path() / (made->id + ".json"));
  for (const auto& file : files) {
    const auto before = read_whole(file, 1 << 24);
    ASSERT_TRUE(before);
    auto changed = *before;
    changed[changed.size() / 2] ^= std::byte{1};
    write(file, {reinterpret_cast<const char*>(changed.data()), changed.size()});
    EXPECT_FALSE(folder.verify(made->id, clock_.now(), proceed)) << file;
    write(file, {reinterpret_cast<const char*>(before->data()), before->size()});
  }
  EXPECT_TRUE(folder.verify(made->id, clock_.now(), proceed));
}

TEST_F(BackupTest, IsNotRestoredOverAFolderInUse) {
  auto folder = open();
  const auto made = make(folder);
  ASSERT_TRUE(made);
  const auto restored = folder.restore(made->id, directory_.path(), proceed);
  ASSERT_FALSE(restored);
  EXPECT_EQ(restored.error().code, Errc::Busy);
  std::filesystem::create_directory(directory_ / "empty");
  EXPECT_TRUE(folder.restore(made->id, directory_ / "empty", proceed));
}

TEST_F(BackupTest, UnknownNamesAreNotFound) {
  auto folder = open();
  for (const char* id : {"", "20260101T000000Z", "../store", "20260101T000000Z/../../x"}) {
    EXPECT_EQ(folder.verify(id, clock_.now(), proceed).error().code, Errc::NotFound) << id;
    EXPECT_EQ(folder.remove(id).error().code, Errc::NotFound) << id;
  }
}

TEST_F(BackupTest, RemovingFreesWhatNoOtherNeeds) {
  ASSERT_TRUE(push("O0001", nc_text(4 * kMebi)));
  auto folder = open();
  const auto first = make(folder);
  ASSERT_TRUE(first);
  ASSERT_TRUE(push("O0002", nc_text(4 * kMebi, 2)));
  const auto second = make(folder);
  ASSERT_TRUE(second);
  ASSERT_TRUE(folder.remove(second->id));
  const auto pruned = folder.prune({}, clock_.now());
  ASSERT_TRUE(pruned) << pruned.error().what;
  EXPECT_EQ(pruned->bytes, second->added);
  EXPECT_TRUE(folder.verify(first->id, clock_.now(), proceed));
}

TEST_F(BackupTest, AnUnreadableOneKeepsTheChunks) {
  ASSERT_TRUE(push("O0001", nc_text(kMebi)));
  auto folder = open();
  const auto made = make(folder);
  ASSERT_TRUE(made);
  const auto manifest = path() / (made->id + ".json");
  const auto text = read_whole(manifest, 1 << 24);
  ASSERT_TRUE(text);
  const std::size_t before = chunks().size();
  write(manifest, "{");
  EXPECT_EQ(folder.list()->damaged.size(), 1u);
  const auto pruned = folder.prune({}, clock_.now());
  ASSERT_FALSE(pruned);
  EXPECT_EQ(pruned.error().code, Errc::Corrupt);
  EXPECT_EQ(chunks().size(), before);
  write(manifest, {reinterpret_cast<const char*>(text->data()), text->size()});
  EXPECT_TRUE(folder.verify(made->id, clock_.now(), proceed));
}

TEST_F(BackupTest, AFilePutThereByAPersonStays) {
  auto folder = open();
  ASSERT_TRUE(make(folder));
  write(path() / "chunks" / "README", "mine");
  ASSERT_TRUE(folder.prune({}, clock_.now()));
  EXPECT_TRUE(std::filesystem::exists(path() / "chunks" / "README"));
}

TEST_F(BackupTest, OneProcessUsesAFolder) {
  const auto folder = open();
  const auto second = BackupFolder::open(path());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
}

}  // namespace
}  // namespace dripline::backup
