#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// The files of hot folders.
class FolderFiles : public ContractTest {
 protected:
  FolderFile file_of(std::string_view text, FolderFileState state = FolderFileState::Taken,
                     const std::string& name = "1.nc") {
    FolderFile file;
    file.folder = "cam";
    file.name = name;
    file.sha256 = sha256(text);
    file.size = text.size();
    file.changed_ns = 17;
    file.state = state;
    if (state == FolderFileState::Failed) file.reason = "no rule fits";
    file.taken = clock_.now();
    return file;
  }
  Result<Revision> store(std::uint64_t file, std::string_view text) {
    Upload upload;
    upload.program = "p.nc";
    upload.author = "cam";
    upload.folder_file = file;
    const auto begun = store_->uploads.begin(upload);
    EXPECT_TRUE(begun) << begun.error().what;
    EXPECT_TRUE(store_->uploads.append(begun->id, 0, bytes_of(text)));
    return store_->uploads.commit(begun->id, sha256(text));
  }
  FolderFile newest() { return store_->folders.list("cam", {.limit = 1})->at(0); }
};

TEST_P(FolderFiles, AreStoredInTheTransactionOfTheirRevision) {
  const auto file = store_->folders.begin(file_of("G00 X1.\n"));
  ASSERT_TRUE(file) << file.error().what;
  EXPECT_EQ(newest().state, FolderFileState::Taken);
  const auto revision = store(file->id, "G00 X1.\n");
  ASSERT_TRUE(revision) << revision.error().what;
  reopen();
  EXPECT_EQ(newest().state, FolderFileState::Stored);
  EXPECT_EQ(newest().program, "p.nc");
  EXPECT_EQ(newest().revision, 1u);
  EXPECT_EQ(store_->folders.unfinished("cam")->size(), 1u);
}

TEST_P(FolderFiles, MakeNoRevisionOnceTheyAreNotTakenAnyMore) {
  const auto file = store_->folders.begin(file_of("G00 X1.\n"));
  ASSERT_TRUE(store(file->id, "G00 X1.\n"));
  const auto twice = store(file->id, "G00 X2.\n");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, Errc::NotFound);
  EXPECT_EQ(store_->programs.revisions("p.nc")->size(), 1u);
  ASSERT_TRUE(store_->folders.begin(file_of("G00 X3.\n", FolderFileState::Failed, "2.nc")));
  EXPECT_FALSE(store(newest().id, "G00 X3.\n"));
  EXPECT_EQ(store_->programs.revisions("p.nc")->size(), 1u);
}

TEST_P(FolderFiles, OnlyOneOfANameIsUnfinished) {
  const auto first = store_->folders.begin(file_of("G00 X1.\n"));
  const auto again = store_->folders.begin(file_of("G00 X1.\n"));
  ASSERT_TRUE(again) << "it was never stored";
  EXPECT_NE(first->id, again->id) << "an upload of the first must not store the second";
  EXPECT_EQ(store_->folders.list("cam", {})->size(), 1u);
  ASSERT_TRUE(store_->folders.fail_file(again->id, "an alarm"));
  EXPECT_EQ(store_->folders.begin(file_of("G00 X2.\n")).error().code, Errc::Conflict);
  EXPECT_EQ(store_->folders.fail_file(again->id, "again").error().code, Errc::NotFound);
  ASSERT_TRUE(store_->folders.set_target(again->id, "failed/1.nc"));
  clock_.advance(std::chrono::seconds(1));
  ASSERT_TRUE(store_->folders.set_moved(again->id, clock_.now()));
  EXPECT_EQ(newest().reason, "an alarm");
  EXPECT_EQ(newest().target, "failed/1.nc");
  EXPECT_EQ(newest().moved, clock_.now());
  EXPECT_TRUE(store_->folders.unfinished("cam")->empty());
  EXPECT_EQ(store_->folders.unfinished("cam", "1.nc").value(), std::nullopt);
  EXPECT_TRUE(store_->folders.begin(file_of("G00 X2.\n")));
}

TEST_P(FolderFiles, AreCountedAndListedByFolder) {
  ASSERT_TRUE(store(store_->folders.begin(file_of("G00 X1.\n"))->id, "G00 X1.\n"));
  ASSERT_TRUE(store_->folders.begin(file_of("?", FolderFileState::Failed, "2.nc")));
  FolderFile other = file_of("?", FolderFileState::Failed, "3.nc");
  other.folder = "lathes";
  ASSERT_TRUE(store_->folders.begin(other));
  const auto counts = store_->folders.counts("cam");
  EXPECT_EQ(counts->stored, 1u);
  EXPECT_EQ(counts->failed, 1u);
  EXPECT_EQ(store_->folders.list(std::nullopt, {})->size(), 3u);
  EXPECT_EQ(store_->folders.list("lathes", {})->at(0).name, "3.nc");
}

ON_BOTH_ENGINES(FolderFiles);

}  // namespace
}  // namespace dripline::storage
