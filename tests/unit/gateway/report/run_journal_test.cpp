#include "gateway/report/run_journal.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "tests/support/temporary_folder.hpp"

namespace dripline::report {
namespace {

Progress at_block(std::uint64_t block) {
  return {block * 5, block + 3, block, block * 2, static_cast<std::int64_t>(block) - 7, block * 11};
}

class RunJournalTest : public testing::Test {
 protected:
  RunJournal open() { return std::move(RunJournal::open(file).value()); }
  test_support::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "run.journal";
};

TEST_F(RunJournalTest, BeginsEmpty) {
  EXPECT_FALSE(open().read().has_value());
}

TEST_F(RunJournalTest, KeepsTheLastEntry) {
  {
    RunJournal journal = open();
    journal.begin("0123456789012345678901234567890123456789");
    for (std::uint64_t block = 1; block <= 101; ++block) journal.write(at_block(block));
    ASSERT_TRUE(journal.sync());
  }
  const auto entry = open().read();
  ASSERT_TRUE(entry.has_value());
  EXPECT_EQ(entry->run, "0123456789012345678901234567890123456789");
  EXPECT_EQ(entry->progress, at_block(101));
}

TEST_F(RunJournalTest, IsEmptyAfterTheRun) {
  {
    RunJournal journal = open();
    journal.begin("run-1");
    journal.clear();
  }
  EXPECT_FALSE(open().read().has_value());
}

/// Every byte of the newest slot in turn is damaged, as a torn write would: the entry before it
/// remains.
TEST_F(RunJournalTest, ATornSlotLeavesTheEntryBefore) {
  {
    RunJournal journal = open();
    journal.begin("run-1");
    journal.write(at_block(1));
    journal.write(at_block(2));  // the third store: into the second slot
  }
  std::string pages;
  {
    std::ifstream stream(file, std::ios::binary);
    pages.assign(std::istreambuf_iterator<char>(stream), {});
  }
  ASSERT_EQ(pages.size(), 256u);
  constexpr std::size_t kUsed = 13 * 8;
  for (std::size_t i = 0; i < kUsed; ++i) {
    std::string torn = pages;
    torn[128 + i] = static_cast<char>(torn[128 + i] ^ 0x5A);
    {
      std::ofstream stream(file, std::ios::binary);
      stream << torn;
    }
    const auto entry = open().read();
    ASSERT_TRUE(entry.has_value()) << "byte " << i;
    EXPECT_EQ(entry->progress, at_block(1)) << "byte " << i;
  }
}

TEST_F(RunJournalTest, NonsenseCountsAsEmpty) {
  {
    std::ofstream stream(file, std::ios::binary);
    stream << std::string(5000, '\x7f');
  }
  EXPECT_FALSE(open().read().has_value());
}

/// A child increments as fast as it can until it is killed. A word beside the journal, stored
/// before and after each write, states which entries are valid.
TEST_F(RunJournalTest, SurvivesKillsAtAnyInstant) {
  struct Truth {
    std::atomic<std::uint64_t> begun, done;
  };
  auto* truth = static_cast<Truth*>(
      ::mmap(nullptr, sizeof(Truth), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(truth, MAP_FAILED);
  std::mt19937 random(20261121);
  for (int i = 0; i < 60; ++i) {
    truth->begun = truth->done = 0;
    const pid_t child = ::fork();
    if (child == 0) {
      auto journal = RunJournal::open(file);
      if (!journal) ::_exit(1);
      journal->begin("run-1");
      for (std::uint64_t block = 1;; ++block) {
        truth->begun.store(block);
        journal->write(at_block(block));
        truth->done.store(block);
      }
    }
    while (truth->done == 0) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 1500));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto entry = open().read();
    ASSERT_TRUE(entry.has_value());
    EXPECT_GE(entry->progress.executed, truth->done);
    EXPECT_LE(entry->progress.executed, truth->begun);
    EXPECT_EQ(entry->progress, at_block(entry->progress.executed));
  }
  ::munmap(truth, sizeof(Truth));
}

}  // namespace
}  // namespace dripline::report
