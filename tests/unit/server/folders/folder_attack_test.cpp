// Who may write into a hot folder, or beside it, gets nothing of the server, and does not stop it.
#include <gtest/gtest.h>

#include "tests/unit/server/folders/hot_folder_fixture.hpp"

namespace dripline::folders {
namespace {

class FolderAttackTest : public HotFolderTest {
 protected:
  FolderAttackTest() {
    fs::create_directories(state());
    std::ofstream(state() / "token.nc") << kGood;
  }
  fs::path state() const { return folder_.path() / "state"; }
  mode_t mode(const fs::path& of) const {
    struct stat facts {};
    EXPECT_EQ(::lstat(of.c_str(), &facts), 0) << of;
    return facts.st_mode & 07777;
  }
  void expect_untouched() {
    EXPECT_EQ(store_->programs.count(), 0u);
    EXPECT_EQ(std::distance(fs::directory_iterator(state()), {}), 1) << "token.nc alone";
  }
};

TEST_F(FolderAttackTest, AnAttackOnItsFoldersLeadsNowhere) {
  fs::create_directory(folder_.path() / "elsewhere");
  fs::create_symlink(folder_.path() / "elsewhere", path() / "done");
  write("O0200.nc", kGood);
  look_twice();
  EXPECT_NE(fault_, "");
  EXPECT_TRUE(fs::is_empty(folder_.path() / "elsewhere"));
  EXPECT_TRUE(fs::exists(path() / "O0200.nc"));
}

/// An operator's word is asked for: the folder that was there is not given up by itself.
TEST_F(FolderAttackTest, AnotherFolderAtItsPathIsAFaultAndNothingOfItIsTaken) {
  look();
  ASSERT_EQ(fault_, "");
  fs::rename(path(), folder_.path() / "cam2");
  fs::create_directory_symlink(state(), path());
  look_twice();
  EXPECT_NE(fault_.find("a symbolic link is there now"), std::string::npos) << fault_;
  expect_untouched();
  fs::remove(path());
  fs::create_directory(path());
  write("O0200.nc", kGood);
  look_twice();
  EXPECT_NE(fault_.find("another folder is there now"), std::string::npos) << fault_;
  EXPECT_EQ(revisions("O0200"), 0u);
  fs::remove_all(path());
  fs::rename(folder_.path() / "cam2", path());
  write("O0200.nc", kGood);
  look_twice();
  EXPECT_EQ(fault_, "") << "the one that was there is back";
  EXPECT_EQ(revisions("O0200"), 1u);
}

TEST_F(FolderAttackTest, ALinkAtItsPathIsRefused) {
  fs::remove(path());
  fs::create_directory_symlink(state(), path());
  look_twice();
  EXPECT_NE(fault_.find("it is a symbolic link"), std::string::npos) << fault_;
  expect_untouched();
}

TEST_F(FolderAttackTest, AFolderOfTheServersOwnIsRefused) {
  fs::create_directory(folder_.path() / "outer");
  fs::create_directory_symlink(folder_.path(), folder_.path() / "outer" / "link");
  own_folders_ = {folder_.path() / "missing", state()};
  const fs::path inner = state() / "inner";
  for (const fs::path& tried :
       {state(), inner, folder_.path(), folder_.path() / "outer" / "link" / "state"}) {
    fs::create_directories(inner);
    settings_.path = tried;
    make();
    look_twice();
    EXPECT_NE(fault_.find("a folder of the server's own"), std::string::npos)
        << tried << ": " << fault_;
    EXPECT_FALSE(fs::exists(tried / "done")) << tried;
    fs::remove_all(inner);
    expect_untouched();
  }
}

TEST_F(FolderAttackTest, ExchangedFoldersForWhatIsDoneOrFailedAreRefused) {
  for (const std::string name : {"done", "failed"}) {
    look();
    ASSERT_EQ(fault_, "") << name;
    fs::rename(path() / name, folder_.path() / name);
    fs::create_directory(path() / name);
    write("O0200.nc", kGood);
    look_twice();
    EXPECT_NE(fault_.find(name + ": another folder is there now"), std::string::npos) << fault_;
    EXPECT_TRUE(fs::exists(path() / "O0200.nc"));
    fs::remove(path() / name);
    fs::rename(folder_.path() / name, path() / name);
  }
  fs::remove(path() / "done");
  look_twice();
  EXPECT_EQ(fault_, "") << "one that is gone is made again";
  EXPECT_TRUE(fs::exists(path() / "done" / "O0200.nc"));
}

/// Opening a pipe that no one reads would wait for ever.
TEST_F(FolderAttackTest, AReasonWaitsForNoPipeAndGoesIntoNoFileOfOthers) {
  look();
  ASSERT_EQ(::mkfifo((path() / "failed" / "pipe.nc.reason.txt.part").c_str(), 0666), 0);
  fs::create_hard_link(state() / "token.nc", path() / "failed" / "link.nc.reason.txt.part");
  fs::create_symlink(state() / "token.nc", path() / "failed" / "sym.nc.reason.txt.part");
  for (const std::string name : {"pipe.nc", "link.nc", "sym.nc"}) {
    write(name, kAlarm);
    EXPECT_NE(refused(name).find("line 4"), std::string::npos) << name;
    EXPECT_TRUE(
        fs::is_regular_file(fs::symlink_status(path() / "failed" / (name + ".reason.txt"))));
  }
  EXPECT_EQ(fs::file_size(state() / "token.nc"), std::string(kGood).size());
  EXPECT_EQ(fault_, "");
}

TEST_F(FolderAttackTest, AHardLinkIsRefused) {
  fs::create_hard_link(state() / "token.nc", path() / "O0200.nc");
  EXPECT_NE(refused("O0200.nc").find("a hard link"), std::string::npos);
  expect_untouched();
}

/// The server's own umask keeps everything of it to itself.
TEST_F(FolderAttackTest, WhatBecameOfAFileIsReadableForThePeopleOfItsFolder) {
  const mode_t before = ::umask(077);
  struct Row {
    mode_t hot, folder, reason;
  };
  for (const Row row : {Row{0770, 0770, 0660}, Row{0777, 0775, 0664}, Row{0755, 0755, 0644},
                        Row{0700, 0700, 0600}, Row{02770, 02770, 0660}}) {
    fs::remove_all(path());
    fs::create_directory(path());
    ASSERT_EQ(::chmod(path().c_str(), row.hot), 0);
    make();
    write("O0200.nc", kAlarm);
    refused("O0200.nc");
    EXPECT_EQ(mode(path() / "done"), row.folder) << std::oct << row.hot;
    EXPECT_EQ(mode(path() / "failed"), row.folder) << std::oct << row.hot;
    EXPECT_EQ(mode(path() / "failed" / "O0200.nc.reason.txt"), row.reason) << std::oct << row.hot;
  }
  ::umask(before);
}

TEST(AnswerWatch, KnowsForHowLongAnAnswerIsWaitedFor) {
  test_support::ManualClock clock;
  AnswerWatch answers(clock);
  clock.advance(std::chrono::seconds(30));
  EXPECT_EQ(answers.silence().count(), 0) << "none is waited for";
  {
    const AnswerWatch::Wait wait(answers);
    clock.advance(std::chrono::seconds(12));
    EXPECT_EQ(answers.silence().count(), 12);
    answers.answered();
    EXPECT_EQ(answers.silence().count(), 0);
    clock.advance(std::chrono::seconds(3));
    EXPECT_EQ(answers.silence().count(), 3);
  }
  EXPECT_EQ(answers.silence().count(), 0);
}

}  // namespace
}  // namespace dripline::folders
