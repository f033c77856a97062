#include "server/library/late_writer.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "tests/support/child_process.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;
using library::LateWriter;

class LateWriterTest : public testing::Test {
 protected:
  /// As a store that is away for a while.
  LateWriter::Write entry(int number) {
    return [this, number]() -> Result<void> {
      ++tries_;
      if (is_away_) return fail(Errc::Io, "the database is away");
      if (number < 0) return fail(Errc::Syntax, "never");
      const std::lock_guard lock(mutex_);
      written_.push_back(number);
      return {};
    };
  }
  std::vector<int> written() {
    const std::lock_guard lock(mutex_);
    return written_;
  }

  std::atomic<bool> is_away_ = false;
  std::atomic<int> tries_ = 0;
  std::mutex mutex_;
  std::vector<int> written_;
  LateWriter writer_{{.retry = 5ms, .patience = 20ms, .max_waiting = 4}};
};

TEST_F(LateWriterTest, IsUsuallyDoneBeforeItReturns) {
  for (int number = 0; number < 50; ++number) writer_.write("one", entry(number));
  EXPECT_TRUE(test_support::eventually([&] { return written().size() == 50; }));
}

TEST_F(LateWriterTest, KeepsOrderAndLosesNothingWhileTheStoreIsAway) {
  is_away_ = true;
  for (int number = 0; number < 3; ++number) writer_.write("one", entry(number));
  EXPECT_TRUE(written().empty());
  EXPECT_TRUE(test_support::eventually([&] { return tries_ > 5; }));
  is_away_ = false;
  EXPECT_TRUE(test_support::eventually([&] { return written() == std::vector{0, 1, 2}; }));
}

TEST_F(LateWriterTest, IsNotHeldUpByWhatTheStoreNeverTakes) {
  writer_.write("bad", entry(-1));
  writer_.write("good", entry(1));
  EXPECT_TRUE(test_support::eventually([&] { return written() == std::vector{1}; }));
}

/// The last try is at the end; what comes then is written by its caller.
TEST_F(LateWriterTest, TriesOnceMoreAtItsEnd) {
  is_away_ = true;
  for (int number = 0; number < 3; ++number) writer_.write("one", entry(number));
  is_away_ = false;
  writer_.end();
  EXPECT_EQ(written(), (std::vector{0, 1, 2}));
  writer_.write("after", entry(3));
  EXPECT_EQ(written().back(), 3);
}

/// Each try may take as long as a silent database is waited for.
TEST_F(LateWriterTest, TriesOneAtItsEndWhileTheStoreIsAway) {
  is_away_ = true;
  for (int number = 0; number < 4; ++number) writer_.write("one", entry(number));
  const int before = tries_;
  writer_.end();
  EXPECT_LE(tries_, before + 2) << "the one in progress, and one more";
}

TEST_F(LateWriterTest, EndsWhileTheStoreIsAway) {
  is_away_ = true;
  writer_.write("one", entry(1));
  writer_.end();
  EXPECT_TRUE(written().empty());
}

}  // namespace
}  // namespace dripline::server_test
