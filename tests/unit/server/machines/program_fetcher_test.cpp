#include "server/machines/program_fetcher.hpp"

#include <set>

#include "tests/support/patience.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

// Programs of running machines are brought near before they are asked for.

namespace dripline::server_test {
namespace {

using machines::ProgramFetcher;

constexpr std::uint64_t kChunk = 1000;  ///< that each takes in the cache

/// Every content has kChunks chunks.
struct FetchedPrograms final : test_support::ProgramStoreDecorator {
  using ProgramStoreDecorator::ProgramStoreDecorator;
  static constexpr std::uint64_t kChunks = 4;

  Result<Fetched> fetch_ahead(const Digest& content, std::uint64_t position) override {
    const std::lock_guard lock(mutex);
    ++asked;
    changed.notify_all();
    if (failures > 0) {
      --failures;
      return fail(error);
    }
    if (position >= kChunks) return Fetched{.is_end = true};
    if (is_full) return Fetched{};
    fetched.insert({content, position});
    order.push_back(content);
    changed.notify_all();
    return Fetched{.bytes = kChunk};
  }
  bool wait(const std::function<bool()>& holds) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, test_support::kPatience, holds);
  }
  bool wait_fetched(std::size_t count) {
    return wait([&] { return fetched.size() >= count; });
  }

  std::mutex mutex;
  std::condition_variable changed;
  std::set<std::pair<Digest, std::uint64_t>> fetched;
  std::vector<Digest> order;
  int asked = 0, failures = 0;
  Error error{Errc::Io, "the database is away"};
  bool is_full = false;
};

class ProgramFetcherTest : public ServerTest {
 protected:
  Run active(const std::string& id, const std::string& program, const std::string& machine) {
    add_machine(machine);
    auto run = run_of(push(program, program + "\nM30\n"), id);
    run.machine = machine;
    EXPECT_TRUE(store_->runs.create(run));
    return run;
  }
  /// All that was there to be done is done.
  void finish_all() {
    int before = -1;
    for (int now = 0; now != before;) {
      before = now;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      const std::lock_guard lock(programs_.mutex);
      now = programs_.asked;
    }
  }

  FetchedPrograms programs_{*store_};
  storage::Store with_ = test_support::with(*store_, programs_);
};

TEST_F(ProgramFetcherTest, FetchesTheProgramsOfTheRunsThatAreUnfinishedAtTheStart) {
  const Run run = active("r1", "O0100", "lathe-1");
  const auto other = push("O0200", "M30\n");
  ASSERT_TRUE(store_->runs.add_call("r1", {"O0200", "O0200", other.number, other.content}));
  ProgramFetcher fetcher(with_, 100 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  EXPECT_TRUE(programs_.wait_fetched(8)) << "of the program and of what it has called";
  fetcher.end();
  EXPECT_TRUE(programs_.fetched.contains({run.content, 3}));
  EXPECT_TRUE(programs_.fetched.contains({other.content, 3}));
}

TEST_F(ProgramFetcherTest, FetchesThoseOfARunThatBeginsAndWhatItCalls) {
  ProgramFetcher fetcher(with_, 100 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  const Run run = active("r1", "O0100", "lathe-1");
  fetcher.note(run);
  fetcher.note(run);
  EXPECT_TRUE(programs_.wait_fetched(4));
  const auto other = push("O0200", "M30\n");
  fetcher.add("r1", other.content);
  EXPECT_TRUE(programs_.wait_fetched(8));
  finish_all();
  fetcher.end();
  EXPECT_EQ(programs_.order.size(), 8u) << "once";
}

TEST_F(ProgramFetcherTest, TakesTheRunsInTurn) {
  const Run first = active("r1", "O0100", "lathe-1"), second = active("r2", "O0200", "lathe-2");
  ProgramFetcher fetcher(with_, 100 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  ASSERT_TRUE(programs_.wait_fetched(8));
  fetcher.end();
  const std::set<Digest> begun(programs_.order.begin(), programs_.order.begin() + 2);
  EXPECT_EQ(begun, (std::set{first.content, second.content}));
}

TEST_F(ProgramFetcherTest, FetchesNoMoreThanItsRoomAndGetsItBack) {
  const Run run = active("r1", "O0100", "lathe-1");
  ProgramFetcher fetcher(with_, 3 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  ASSERT_TRUE(programs_.wait_fetched(3));
  finish_all();
  EXPECT_EQ(programs_.fetched.size(), 3u);
  Run ended = run;
  ended.state = storage::RunState::Completed;
  fetcher.note(ended);
  const Run next = active("r2", "O0200", "lathe-2");
  fetcher.note(next);
  EXPECT_TRUE(programs_.wait_fetched(6));
  finish_all();
  fetcher.end();
  EXPECT_EQ(programs_.fetched.size(), 6u);
}

TEST_F(ProgramFetcherTest, LeavesARunThatHasEnded) {
  Run run = active("r1", "O0100", "lathe-1");
  programs_.failures = 1;
  ProgramFetcher fetcher(with_, 100 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  ASSERT_TRUE(programs_.wait([&] { return programs_.asked > 0; }));
  run.state = storage::RunState::Aborted;
  fetcher.note(run);  // while it waits for the store
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  fetcher.add("r1", run.content);
  finish_all();
  fetcher.end();
  EXPECT_TRUE(programs_.fetched.empty());
}

TEST_F(ProgramFetcherTest, GoesOnWhenTheStoreIsBack) {
  active("r1", "O0100", "lathe-1");
  programs_.failures = 1;
  ProgramFetcher fetcher(with_, 100 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  EXPECT_TRUE(programs_.wait_fetched(4));
}

TEST_F(ProgramFetcherTest, GivesUpAProgramThatIsDamagedOrCannotBeKept) {
  active("r1", "O0100", "lathe-1");
  programs_.failures = 1;
  programs_.error = {Errc::Corrupt, "chunk 0 is damaged"};
  ProgramFetcher fetcher(with_, 100 * kChunk);
  ASSERT_TRUE(fetcher.begin());
  ASSERT_TRUE(programs_.wait([&] { return programs_.asked == 1; }));
  finish_all();
  EXPECT_EQ(programs_.asked, 1);
  {
    const std::lock_guard lock(programs_.mutex);
    programs_.is_full = true;
  }
  fetcher.note(active("r2", "O0200", "lathe-2"));
  ASSERT_TRUE(programs_.wait([&] { return programs_.asked == 2; }));
  finish_all();
  EXPECT_EQ(programs_.asked, 2);
}

}  // namespace
}  // namespace dripline::server_test
