#include "tests/unit/server/folders/hot_folder_fixture.hpp"

#include <fcntl.h>

namespace dripline::folders {
namespace {

TEST_F(HotFolderTest, TakesAFileOnceItDoesNotChange) {
  write("O0200.nc", kGood);
  look();
  EXPECT_EQ(revisions("O0200"), 0u);
  EXPECT_EQ(hot_->state().waiting, 1u);
  clock_.advance(settings_.unchanged_time / 2);
  write("O0200.nc", std::string(kGood) + "%\n");
  look();
  clock_.advance(settings_.unchanged_time / 2);
  look();
  EXPECT_EQ(revisions("O0200"), 0u) << "it changed since";
  clock_.advance(settings_.unchanged_time / 2);
  look();
  ASSERT_EQ(revisions("O0200"), 1u);
  const auto revision = store_->programs.revision("O0200", 1);
  EXPECT_EQ(revision->author, "folder cam");
  EXPECT_EQ(revision->comment, "O0200.nc");
  EXPECT_EQ(revision->control, "fanuc");
  EXPECT_FALSE(revision->is_held);
  EXPECT_TRUE(fs::exists(path() / "done" / "O0200.nc"));
  EXPECT_FALSE(fs::exists(path() / "O0200.nc"));
  EXPECT_EQ(hot_->state().counts.stored, 1u);
  EXPECT_EQ(hot_->state().waiting, 0u);
  EXPECT_EQ(fault_, "");
}

TEST_F(HotFolderTest, TakesWhatIsRenamedIntoItAtOnce) {
  write("O0200.nc", kGood);
  look({.whole = {"O0200.nc"}, .written = {}});
  EXPECT_EQ(revisions("O0200"), 1u);
}

TEST_F(HotFolderTest, LeavesWhatIsOpenForWriting) {
  write("O0200.nc", kGood);
  const int writer = ::open((path() / "O0200.nc").c_str(), O_WRONLY | O_APPEND);
  look_twice();
  EXPECT_EQ(revisions("O0200"), 0u)
      << "the system knows: it is ours, and on a disk of this computer";
  ::close(writer);
  look_twice();
  EXPECT_EQ(revisions("O0200"), 1u);
  write("O0300.nc", kGood);
  look();
  clock_.advance(settings_.unchanged_time);
  look({.whole = {}, .written = {"O0300.nc"}});
  EXPECT_EQ(revisions("O0300"), 0u) << "it was written to, and was not closed";
}

TEST_F(HotFolderTest, RefusesAProgramWithAnAlarmAndSaysWhy) {
  write("O0200.nc", kAlarm);
  const std::string why = refused("O0200.nc");
  EXPECT_NE(why.find("machine mill-1 would not take it: line 4"), std::string::npos) << why;
  EXPECT_EQ(revisions("O0200"), 0u);
  EXPECT_EQ(hot_->state().counts.failed, 1u);
  EXPECT_EQ(hot_->state().last_refused, "O0200.nc");
  settings_.is_checked = false;
  make();
  write("O0200.nc", kAlarm);
  look_twice();
  EXPECT_EQ(revisions("O0200"), 1u);
}

/// The check uses the setup of the machine, and the programs of the library.
TEST_F(HotFolderTest, ChecksWithTheMachinesSetupAndCalledPrograms) {
  write("O0200.nc", "O200\nM98 P77\nM30\n");
  EXPECT_NE(refused("O0200.nc").find("line 2"), std::string::npos);
  push("O0077", "O77\nG0 X1.\nM99\n", "fanuc");
  write("O0200.nc", "O200\nM98 P77\nM30\n");
  look_twice();
  EXPECT_EQ(revisions("O0200"), 1u) << reason("O0200.2.nc");
}

TEST_F(HotFolderTest, RefusesWhatIsNoFileAndFollowsNoLink) {
  write("../secret", "O1\nM30\n");
  fs::create_symlink(folder_.path() / "secret", path() / "link.nc");
  EXPECT_NE(refused("link.nc").find("a symbolic link"), std::string::npos);
  EXPECT_TRUE(fs::is_symlink(path() / "failed" / "link.nc"));
  ASSERT_EQ(::mkfifo((path() / "pipe.nc").c_str(), 0600), 0);
  EXPECT_NE(refused("pipe.nc").find("a pipe"), std::string::npos);
  fs::create_directory(path() / "sub.nc");
  look_twice();
  EXPECT_TRUE(fs::exists(path() / "sub.nc")) << "its maker may be in it";
  EXPECT_NE(reason("sub.nc").find("it is a folder"), std::string::npos);
  write("bad\nname.nc", kGood);
  EXPECT_NE(refused("bad%0Aname.nc").find("control characters"), std::string::npos);
  EXPECT_EQ(store_->programs.count(), 0u);
}

TEST_F(HotFolderTest, RefusesWhatIsTooBigUnknownOrEmpty) {
  settings_.max_bytes = 100;
  make();
  write("big.nc", std::string(101, ' '));
  EXPECT_NE(refused("big.nc").find("the folder's limit is 100"), std::string::npos);
  write("empty.nc", "");
  EXPECT_NE(refused("empty.nc"), "");
  settings_.machine = "mill-9";
  make();
  write("a.nc", kGood);
  EXPECT_NE(refused("a.nc").find("mill-9"), std::string::npos);
  settings_.machine = "";
  make();
  write("b.nc", kGood);
  EXPECT_NE(refused("b.nc").find("which control"), std::string::npos);
}

TEST_F(HotFolderTest, LeavesTemporaryAndIgnoredFiles) {
  settings_.rules = read_folders(
                        "[[folder]]\nname=\"x\"\npath=\"/x\"\n[[folder.rule]]\nmatches='.*\\.txt'\n"
                        "ignore=true\n[[folder.rule]]\nmatches='O.*'\n")
                        ->front()
                        .rules;
  make();
  write("O1.nc.tmp", kGood);
  write("notes.txt", "later");
  look_twice();
  EXPECT_TRUE(fs::exists(path() / "O1.nc.tmp"));
  EXPECT_TRUE(fs::exists(path() / "notes.txt"));
  write("part.nc", kGood);
  EXPECT_NE(refused("part.nc").find("no rule"), std::string::npos);
}

TEST_F(HotFolderTest, APostOfTheSameNameIsTakenAgain) {
  write("O0200.nc", kGood);
  look_twice();
  write("O0200.nc", std::string(kGood) + "%\n");
  look_twice();
  write("O0200.nc", kGood);
  look_twice();
  EXPECT_EQ(revisions("O0200"), 3u) << "the first text again is a new revision";
  EXPECT_TRUE(fs::exists(path() / "done" / "O0200.nc"));
  EXPECT_TRUE(fs::exists(path() / "done" / "O0200.2.nc"));
  EXPECT_TRUE(fs::exists(path() / "done" / "O0200.3.nc"));
}

/// As after a kill between the store's transaction and the move.
TEST_F(HotFolderTest, AStoredFileThatIsStillThereIsOnlyMoved) {
  write("O0200.nc", kGood);
  look_twice();
  push("O0200", "O1\nG0 X2.\nM30\n", "fanuc");
  fs::rename(path() / "done" / "O0200.nc", path() / "O0200.nc");
  const auto file = store_->folders.list("cam", {})->at(0);
  store_.reset();
  {
    auto database = storage::SqliteStore::open({.file = folder_.path() / "store.sqlite"}, clock_);
    ASSERT_TRUE(database);
  }
  const std::string undo = "sqlite3 " + (folder_.path() / "store.sqlite").string() +
                           " 'UPDATE folder_file SET moved_us = NULL'";
  ASSERT_EQ(std::system(undo.c_str()), 0);
  hot_.reset();
  reopen();
  make();
  look_twice();
  EXPECT_EQ(revisions("O0200"), 2u) << "it was stored before";
  EXPECT_TRUE(fs::exists(path() / "done" / "O0200.nc"));
  EXPECT_FALSE(fs::exists(path() / "O0200.nc"));
  EXPECT_TRUE(store_->folders.unfinished("cam")->empty());
  EXPECT_EQ(store_->folders.list("cam", {})->size(), 1u);
}

TEST_F(HotFolderTest, AFolderThatIsGoneIsAFaultUntilItIsBack) {
  fs::rename(path(), folder_.path() / "away");
  look();
  EXPECT_NE(fault_.find("No such file"), std::string::npos) << fault_;
  EXPECT_EQ(hot_->state().fault, fault_);
  fs::rename(folder_.path() / "away", path());
  look();
  EXPECT_EQ(fault_, "");
}

}  // namespace
}  // namespace dripline::folders
