#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <random>
#include <thread>

#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

/// The server as another process that approves every proposal it finds, killed at any moment.
class KilledOffsets : public OffsetsTest {
 protected:
  void approve_in_a_process(std::optional<std::chrono::microseconds> life) {
    offsets_.reset();
    close_store();
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) approve_all();
    if (life) {
      std::this_thread::sleep_for(
          *life);  // the moment of the kill is what is tried; nothing is waited for
      ::kill(child, SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (!life) {
      EXPECT_EQ(status, 0);
    }
    reopen();
    start();
  }

 private:
  [[noreturn]] void approve_all() {
    auto store = storage::SqliteStore::open({.file = file()}, clock_);
    if (!store) ::_exit(1);
    library::AuditTrail audit((*store)->audit, clock_);
    library::Setups setups((*store)->setups, catalog_, audit);
    Offsets offsets({.store = **store, .setups = setups, .clock = clock_});
    const auto pending = (*store)->offsets.list({.state = storage::OffsetState::Pending}, {});
    if (!pending) ::_exit(2);
    for (const auto& proposal : *pending)
      (void)offsets.approve({.id = proposal.id, .who = "anna", .time = {}});
    ::_exit(0);
  }
};

TEST_F(KilledOffsets, ApplyEachCorrectionOnceOrNotAtAll) {
  use_rules();
  std::mt19937 random(20261124);
  std::uniform_int_distribution<int> some(0, 30000);
  std::size_t applied = 0;
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    for (int part = 0; part < 3; ++part) measure(40.02);
    const auto proposal = only_proposal();
    const double before = wear();
    approve_in_a_process(std::chrono::microseconds(some(random)));
    const auto state = store_->offsets.find(proposal.id)->state;
    if (state == storage::OffsetState::Applied) {
      EXPECT_DOUBLE_EQ(wear(), proposal.new_value);
    } else {
      EXPECT_EQ(state, storage::OffsetState::Pending);
      EXPECT_DOUBLE_EQ(wear(), before);
    }
    approve_in_a_process(std::nullopt);
    EXPECT_DOUBLE_EQ(wear(), proposal.new_value);
    ++applied;
    EXPECT_EQ(store_->setups.list("lathe-1", {})->size(), applied + 1);
    EXPECT_EQ(all(storage::OffsetState::Applied).size(), applied);
  }
}

}  // namespace
}  // namespace dripline::offsets
