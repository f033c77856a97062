// Machines are fed while the database is away, or does not answer.
#include "tests/support/patience.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

using machines::BlockFeed;

/// A database that answers, fails, or does not answer at all.
class Away {
 public:
  enum class State { Answers, Fails, Hangs };
  void set(State state) {
    {
      const std::lock_guard lock(mutex_);
      state_ = state;
    }
    changed_.notify_all();
  }
  Result<void> ask() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return state_ != State::Hangs; });
    --waiting_;
    if (state_ == State::Answers) return {};
    return fail(Errc::Io, "the database is away");
  }
  /// So many callers hang.
  bool wait_hanging(int callers) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, test_support::kPatience, [&] { return waiting_ >= callers; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::Answers;
  int waiting_ = 0;
};

struct AwayPrograms final : test_support::ProgramStoreDecorator {
  AwayPrograms(const storage::Store& inner, Away& state)
      : ProgramStoreDecorator(inner), away(state), all(inner.programs) {}
  Result<std::vector<std::byte>> read_content(const Digest& content, std::uint64_t offset,
                                              std::uint64_t length) override {
    if (auto there = away.ask(); !there) return fail(there.error());
    return ProgramStoreDecorator::read_content(content, offset, length);
  }
  std::optional<std::vector<std::byte>> near_content(const Digest& content, std::uint64_t offset,
                                                     std::uint64_t length) override {
    if (offset + length > near_to) return std::nullopt;
    auto bytes = all.read_content(content, offset, length);
    return bytes ? std::optional(*std::move(bytes)) : std::nullopt;
  }
  Away& away;
  storage::ProgramStore& all;
  std::atomic<std::uint64_t> near_to = 0;
};

struct AwayRuns final : test_support::RunStoreDecorator {
  AwayRuns(const storage::Store& inner, Away& state) : RunStoreDecorator(inner), away(state) {}
  Result<storage::Run> find(const std::string& id) override {
    if (auto there = away.ask(); !there) return fail(there.error());
    return RunStoreDecorator::find(id);
  }
  Away& away;
};

std::string lines(std::size_t size) {
  std::string text;
  for (int n = 0; text.size() < size; ++n) text += fmt::format("N{} G01 X{}.5\n", n, n % 90);
  return text;
}

class NearFeedTest : public MachineServiceTest {
 protected:
  /// A run whose first bytes were fed.
  void run_until_fed() {
    push("O0100", text_);
    start_service(both_);
    announce();
    answer_commands(true);
    const auto run = start("O0100");
    ASSERT_TRUE(run) << run.error().what;
    run_ = run->id;
    request(run_, 0, 100);
    ASSERT_EQ(fed(1), text_.substr(0, 100));
  }
  void TearDown() override {
    away_.set(Away::State::Answers);  // its workers end
    if (service_) service_->end();
  }
  bool is_answered(std::size_t count) {
    return written_->wait([&] { return written_->blocks.size() >= count; });
  }
  std::size_t answers() {
    const std::lock_guard lock(written_->mutex);
    return written_->blocks.size();
  }

  const std::string text_ = lines(100'000);
  Away away_;
  AwayPrograms programs_{*store_, away_};
  AwayRuns runs_{*store_, away_};
  storage::Store with_runs_ = test_support::with(*store_, runs_);
  storage::Store both_ = test_support::with(with_runs_, programs_);
  std::string run_;
};

TEST_F(NearFeedTest, AStoreThatDoesNotAnswerDelaysNoMachineWhoseTextIsNear) {
  programs_.near_to = 50'000;
  run_until_fed();
  away_.set(Away::State::Hangs);
  // More than there are workers wait for the store.
  for (int i = 0; i < 8; ++i) {
    network_.on_request({.machine = fmt::format("lathe-{}", i + 2),
                         .session = kSession,
                         .run = "another",
                         .program = "",
                         .offset = 0,
                         .length = 100});
  }
  ASSERT_TRUE(away_.wait_hanging(3));
  for (std::uint64_t at = 100; at < 50'000; at += 9980) request(run_, at, 9980);
  EXPECT_EQ(fed(6).size(), 50'000u);
}

TEST_F(NearFeedTest, WhatIsNotNearWaitsForTheStore) {
  run_until_fed();
  away_.set(Away::State::Hangs);
  request(run_, 100, 900);
  ASSERT_TRUE(away_.wait_hanging(1));
  EXPECT_EQ(answers(), 1u);
  away_.set(Away::State::Answers);
  EXPECT_EQ(fed(2), text_.substr(0, 1000));
}

TEST_F(NearFeedTest, AStoreThatIsAwayFailsNoRunWhenItReturnsInTime) {
  run_until_fed();
  away_.set(Away::State::Fails);
  request(run_, 100, 900);
  clock_.advance(BlockFeed::kPatience - std::chrono::seconds(1));
  std::this_thread::sleep_for(3 * BlockFeed::kAwayPause);  // it is asked again meanwhile
  EXPECT_EQ(answers(), 1u) << "no failure was reported";
  away_.set(Away::State::Answers);
  EXPECT_EQ(fed(2), text_.substr(0, 1000));
}

TEST_F(NearFeedTest, AMachineIsToldOfAStoreThatStaysAway) {
  run_until_fed();
  away_.set(Away::State::Fails);
  request(run_, 100, 900);
  std::this_thread::sleep_for(BlockFeed::kAwayPause / 2);  // it was asked once
  clock_.advance(BlockFeed::kPatience + std::chrono::seconds(1));
  // That is long after it was seen, so another wait begins, and ends.
  std::this_thread::sleep_for(BlockFeed::kAwayPause * 3 / 2);
  clock_.advance(BlockFeed::kPatience);
  ASSERT_TRUE(is_answered(2));
  const std::lock_guard lock(written_->mutex);
  EXPECT_EQ(written_->blocks[1].status, dds::BlockStatus::Failed);
  EXPECT_EQ(written_->blocks[1].reason, "the database is away");
}

TEST_F(NearFeedTest, ARunThatHasEndedGetsNothingThatIsNear) {
  programs_.near_to = 50'000;
  run_until_fed();
  record(1, run_, dds::RecordKind::RunEnded, completed(text_, 1));
  ASSERT_TRUE(wait_ack(1));
  request(run_, 100, 10);
  ASSERT_TRUE(is_answered(2));
  const std::lock_guard lock(written_->mutex);
  EXPECT_EQ(written_->blocks[1].status, dds::BlockStatus::NoSuchRun);
}

}  // namespace
}  // namespace dripline::server_test
