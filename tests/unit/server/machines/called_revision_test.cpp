// Which revision a run gets of a program that it calls, when clocks are set back or differ.
#include "server/machines/control_memory.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

using library::ReleasePolicy;
using library::Releases;

constexpr std::chrono::hours kAhead{2};

class CalledRevision : public ContractTest {
 protected:
  void SetUp() override { use(""); }
  void use(const std::string& policy) {
    auto parsed = ReleasePolicy::parse(policy);
    ASSERT_TRUE(parsed) << parsed.error().what;
    policy_ = *std::move(parsed);
    decide_with_store();
  }
  void decide_with_store() {
    releases_ = std::make_unique<Releases>(
        Releases::Parts{.store = *store_,
                        .clock = clock_,
                        .key = SigningKey::of(std::string(64, '8')).value(),
                        .database = store_->identity().value()},
        policy_);
  }
  void decide(std::uint64_t revision, RevisionStep step, const std::string& program = "O0830") {
    const auto decided = releases_->decide({.program = program,
                                            .revision = revision,
                                            .step = step,
                                            .comment = {},
                                            .who = {"anna", "token", ""},
                                            .role = Role::Administrator});
    ASSERT_TRUE(decided) << decided.error().what;
  }
  void release(std::uint64_t revision, const std::string& program = "O0830") {
    using enum RevisionStep;
    for (const auto step : {Submit, Approve, Release}) decide(revision, step, program);
  }
  /// A run of p.nc that begins now; the one before has ended.
  Run begin_run(const std::string& id, RunAllowance allowed_as = RunAllowance::Open) {
    Run run = make_run(id);
    run.allowed_as = allowed_as;
    const auto created = store_->runs.create(run);
    EXPECT_TRUE(created) << created.error().what;
    return store_->runs.find(id).value();
  }
  void end(const Run& run) {
    ASSERT_TRUE(store_->runs.set_state(run.id, RunState::Interrupted, "cut off"));
  }
  Result<Revision> called(const Run& run) {
    return machines::resolve_called_program({*store_, *releases_, clock_}, run, "O0830");
  }
  std::uint64_t number_called(const Run& run) {
    const auto revision = called(run);
    EXPECT_TRUE(revision) << revision.error().what;
    return revision ? revision->number : 0;
  }

  ReleasePolicy policy_;
  std::unique_ptr<Releases> releases_;
};

TEST_P(CalledRevision, WithdrawnWhileTheClockWasAheadDoesNotRun) {
  ASSERT_TRUE(push("O0830", "G1 X1\nM99\n"));
  clock_.advance(kAhead);
  decide(1, RevisionStep::Withdraw);
  clock_.advance(-kAhead);
  EXPECT_EQ(called(begin_run("r1")).error().code, Errc::NotFound);
}

TEST_P(CalledRevision, WithdrawnAheadDoesNotRunWhereReleasesAreAskedFor) {
  use("runs = \"release\"");
  ASSERT_TRUE(push("O0830", "G1 X1\nM99\n"));
  release(1);
  make_run("r0");
  release(1, "p.nc");
  const Run before = begin_run("r1", RunAllowance::Released);
  EXPECT_EQ(number_called(before), 1u);
  end(before);
  clock_.advance(kAhead);
  decide(1, RevisionStep::Withdraw);
  clock_.advance(-kAhead);
  EXPECT_EQ(called(begin_run("r2", RunAllowance::Released)).error().code, Errc::NotFound);
}

TEST_P(CalledRevision, ThatIsNewestRunsAlsoWhenItCameWhileTheClockWasAhead) {
  ASSERT_TRUE(push("O0830", "G1 X1\nM99\n"));
  clock_.advance(kAhead);
  ASSERT_TRUE(push("O0830", "G1 X2\nM99\n"));
  clock_.advance(-kAhead);
  EXPECT_EQ(number_called(begin_run("r1")), 2u);
}

TEST_P(CalledRevision, ThatIsReleasedLastRunsAlsoWhenTheClockWasAhead) {
  use("runs = \"release\"");
  make_run("r0");
  release(1, "p.nc");
  clock_.advance(kAhead);
  ASSERT_TRUE(push("O0830", "G1 X1\nM99\n"));
  release(1);
  clock_.advance(-kAhead);
  EXPECT_EQ(number_called(begin_run("r1", RunAllowance::Released)), 1u);
}

/// The run's clock is ahead of the one by which others change the library meanwhile.
TEST_P(CalledRevision, IsKeptByARunThatBeganBefore) {
  ASSERT_TRUE(push("O0830", "G1 X1\nM99\n"));
  clock_.advance(kAhead);
  const Run run = begin_run("r1");
  clock_.advance(-kAhead);
  ASSERT_TRUE(push("O0830", "G1 X2\nM99\n"));
  decide(1, RevisionStep::Withdraw);
  EXPECT_EQ(number_called(run), 1u);
  end(run);
  EXPECT_EQ(number_called(begin_run("r2")), 2u);
}

TEST_P(CalledRevision, AcceptedAfterTheRunBeganIsForTheNextOne) {
  Upload held;
  held.program = "O0830";
  held.control = "centurion";
  held.author = "machine m1";
  held.is_held = true;
  const auto upload = store_->uploads.begin(held);
  ASSERT_TRUE(upload) << upload.error().what;
  ASSERT_TRUE(store_->uploads.append(upload->id, 0, bytes_of("G1 X1\nM99\n")));
  ASSERT_TRUE(store_->uploads.commit(upload->id, std::nullopt));
  clock_.advance(kAhead);
  const Run run = begin_run("r1");
  clock_.advance(-kAhead);
  ASSERT_TRUE(store_->programs.accept("O0830", 1, "anna"));
  EXPECT_FALSE(called(run));
  end(run);
  EXPECT_EQ(number_called(begin_run("r2")), 1u);
}

/// What was stored before version 25 has no order: what is withdrawn does not run, but where a
/// machine has text of it already.
TEST_P(CalledRevision, OfBeforeIsJudgedByWhatIsDecidedNow) {
  ASSERT_TRUE(push("O0830", "G1 X1\nM99\n"));
  const Run run = begin_run("r1");
  decide(1, RevisionStep::Withdraw);
  damage("UPDATE revision SET in_force_after = NULL, withdrawn_after = NULL");
  decide_with_store();
  EXPECT_FALSE(called(run));
  const auto content = store_->programs.revision("O0830", 1)->content;
  ASSERT_TRUE(store_->runs.add_call("r1", {"O0830", "O0830", 1, content}));
  EXPECT_EQ(number_called(run), 1u);
  end(run);
  EXPECT_FALSE(called(begin_run("r2")));
}

ON_BOTH_ENGINES(CalledRevision);

}  // namespace
}  // namespace dripline::storage
