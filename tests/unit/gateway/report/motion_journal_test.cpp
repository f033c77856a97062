#include "gateway/report/motion_journal.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::report {
namespace {

class MotionJournalTest : public testing::Test {
 protected:
  MotionJournal open() { return std::move(MotionJournal::open(file).value()); }
  static MotionJournal::Entry entry(std::uint64_t block) {
    MotionJournal::Entry entry;
    entry.place.executed = entry.action.origin.block = block;
    entry.action.end[2] = static_cast<double>(block) / 8;
    return entry;
  }
  static std::vector<std::uint64_t> blocks(const std::vector<MotionJournal::Entry>& entries) {
    std::vector<std::uint64_t> blocks;
    for (const auto& one : entries) {
      EXPECT_EQ(one.place.executed, one.action.origin.block);
      EXPECT_EQ(one.action.end[2], static_cast<double>(one.place.executed) / 8);
      blocks.push_back(one.place.executed);
    }
    return blocks;
  }
  using Blocks = std::vector<std::uint64_t>;
  test_support::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "motion.journal";
};

TEST_F(MotionJournalTest, HasWhatFollowsTheBlockExecutedLast) {
  {
    MotionJournal journal = open();
    journal.begin("run-1");
    for (std::uint64_t block = 1; block <= 5; ++block) journal.write(entry(block));
  }
  const MotionJournal journal = open();
  EXPECT_EQ(blocks(journal.read("run-1", 2)), (Blocks{3, 4, 5}));
  EXPECT_EQ(blocks(journal.read("run-1", 5)), Blocks{});
  EXPECT_EQ(blocks(journal.read("run-2", 0)), Blocks{});
}

TEST_F(MotionJournalTest, HasNothingOfTheRunBefore) {
  {
    MotionJournal journal = open();
    journal.begin("run-1");
    for (std::uint64_t block = 1; block <= 5; ++block) journal.write(entry(block));
    journal.begin("run-2");
    journal.write(entry(1));
  }
  EXPECT_EQ(blocks(open().read("run-2", 0)), (Blocks{1}));
}

TEST_F(MotionJournalTest, GoesAroundItsRing) {
  MotionJournal journal = open();
  journal.begin("run-1");
  const std::uint64_t last = 3 * MotionJournal::kEntries + 5;
  for (std::uint64_t block = 1; block <= last; ++block) journal.write(entry(block));
  const std::uint64_t oldest = last - MotionJournal::kEntries + 1;
  EXPECT_EQ(journal.read("run-1", oldest).size(), MotionJournal::kEntries - 1);
  EXPECT_EQ(blocks(journal.read("run-1", oldest - 1)), Blocks{}) << "whether there was more";
}

/// A gateway that is killed while it writes has not given that motion to the machine.
TEST_F(MotionJournalTest, LeavesOutAnEntryThatIsHalfWritten) {
  {
    MotionJournal journal = open();
    journal.begin("run-1");
    for (std::uint64_t block = 1; block <= 3; ++block) journal.write(entry(block));
  }
  std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
  const auto size = std::filesystem::file_size(file);
  const auto slot = size / MotionJournal::kEntries;  // the header is less than one
  const auto header = size - slot * MotionJournal::kEntries;
  const auto after_of_third = header + 4 * slot - 8;
  bytes.seekp(static_cast<std::streamoff>(after_of_third));
  bytes.put('\0');
  bytes.close();
  EXPECT_EQ(blocks(open().read("run-1", 0)), (Blocks{1, 2}));
}

TEST_F(MotionJournalTest, IsEmptyAfterAnotherVersion) {
  std::ofstream(file, std::ios::binary) << std::string(8'000'000, 'x');
  MotionJournal journal = open();
  EXPECT_EQ(blocks(journal.read("xxxx", 0)), Blocks{});
  journal.begin("run-1");
  journal.write(entry(1));
  EXPECT_EQ(blocks(journal.read("run-1", 0)), Blocks{1});
}

}  // namespace
}  // namespace dripline::report
