#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// The job queue of machine m1.
class JobQueueTest : public StoreTest {
 protected:
  void SetUp() override {
    run_ = make_run("r0");  // the machine and the program
    ASSERT_TRUE(push("q.nc", "G00 X2.\n"));
  }
  Job add(const std::string& program = "p.nc", std::uint64_t quantity = 1,
          std::optional<std::uint64_t> place = {}) {
    Job job;
    job.machine = "m1";
    job.program = program;
    job.quantity = quantity;
    job.author = "anna";
    job.created = clock_.now();
    auto added = store_->jobs.add(job, "anna", place);
    EXPECT_TRUE(added) << added.error().what;
    return added.value_or(Job{});
  }
  Result<void> start(const std::string& id, std::uint64_t job) {
    Run run = run_;
    run.id = id;
    run.job = job;
    return store_->runs.create(run);
  }
  void end(const std::string& id, RunState state = RunState::Completed) {
    ASSERT_TRUE(store_->runs.set_state(id, state, ""));
  }
  std::vector<std::uint64_t> order() {
    std::vector<std::uint64_t> ids;
    const auto jobs = store_->jobs.list("m1", true, {});
    for (const Job& job : *jobs) ids.push_back(job.id);
    return ids;
  }
  Run run_;
};

TEST_F(JobQueueTest, KeepsItsOrderOverMovesAndARestart) {
  const auto a = add().id, b = add().id, c = add("q.nc", 1, 1).id, d = add().id;
  EXPECT_EQ(order(), (std::vector{c, a, b, d}));
  ASSERT_TRUE(store_->jobs.move(d, 2, "anna", clock_.now()));
  ASSERT_TRUE(store_->jobs.move(c, 99, "anna", clock_.now()));
  reopen();
  EXPECT_EQ(order(), (std::vector{d, a, b, c}));
  ASSERT_TRUE(store_->jobs.remove(a, "anna", clock_.now()));
  EXPECT_EQ(order(), (std::vector{d, b, c}));
  EXPECT_EQ(store_->jobs.list("m1", false, {})->at(0).state, JobState::Removed);
  EXPECT_EQ(store_->jobs.remove(a, "anna", clock_.now()).error().code, Errc::Conflict);
  EXPECT_EQ(store_->audit.list({.limit = 1})->at(0).action, "job.remove");
}

TEST_F(JobQueueTest, CountsPartsOfCompletedRunsOnly) {
  const auto job = add("p.nc", 2).id;
  ASSERT_TRUE(start("r1", job));
  EXPECT_EQ(store_->jobs.find(job)->state, JobState::Active);
  EXPECT_EQ(store_->jobs.remove(job, "anna", clock_.now()).error().code, Errc::Busy);
  end("r1", RunState::Interrupted);
  EXPECT_EQ(store_->jobs.find(job)->completed, 0u);
  ASSERT_TRUE(start("r2", job));
  end("r2");
  reopen();
  EXPECT_EQ(store_->jobs.find(job)->completed, 1u);
  EXPECT_EQ(store_->jobs.find(job)->runs, 2u);
  EXPECT_EQ(store_->jobs.next("m1").value()->id, job);
  ASSERT_TRUE(start("r3", job));
  end("r3");
  EXPECT_EQ(store_->jobs.find(job)->state, JobState::Done);
  EXPECT_EQ(store_->jobs.next("m1").value(), std::nullopt);
  const auto more = start("r4", job);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, Errc::Conflict);
}

/// The end of a run counts once, however often its record is sent.
TEST_F(JobQueueTest, CountsAnEndingOnce) {
  const auto job = add("p.nc", 5).id;
  ASSERT_TRUE(start("r1", job));
  auto batch = make_batch(1, 2);
  batch.records[0].kind = "run_started";
  batch.records[1].kind = "run_ended";
  batch.beginnings = {{"r1", clock_.now()}};
  RunEnding ending;
  ending.run = "r1";
  ending.ended = clock_.now();
  batch.endings.push_back(ending);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(store_->jobs.find(job)->completed, 1u);
}

TEST_F(JobQueueTest, SeveralPartsPerRun) {
  Job job;
  job.machine = "m1";
  job.program = "p.nc";
  job.quantity = 5;
  job.parts_per_run = 3;
  const auto id = store_->jobs.add(job, "anna", {})->id;
  ASSERT_TRUE(start("r1", id));
  end("r1");
  EXPECT_EQ(store_->jobs.find(id)->completed, 3u);
  ASSERT_TRUE(start("r2", id));
  end("r2");
  EXPECT_EQ(store_->jobs.find(id)->state, JobState::Done);
}

TEST_F(JobQueueTest, AHeldQueueStartsNothing) {
  const auto job = add("p.nc", 2).id;
  ASSERT_TRUE(store_->jobs.hold({"m1", "quality", "bore is wide", clock_.now()}, "quality"));
  reopen();
  EXPECT_EQ(store_->jobs.hold_of("m1").value()->reason, "bore is wide");
  const auto held = start("r1", job);
  ASSERT_FALSE(held);
  EXPECT_EQ(held.error().code, Errc::Conflict);
  EXPECT_NE(held.error().what.find("bore is wide"), std::string::npos);
  Run alone = run_;
  alone.id = "r2";
  EXPECT_TRUE(store_->runs.create(alone)) << "it is of no job";
  end("r2", RunState::Aborted);
  ASSERT_TRUE(store_->jobs.release("m1", "anna", clock_.now()));
  EXPECT_TRUE(start("r3", job));
  EXPECT_EQ(store_->jobs.release("m1", "anna", clock_.now()).error().code, Errc::NotFound);
  EXPECT_EQ(store_->jobs.hold({"m9", "a", "b", clock_.now()}, "a").error().code, Errc::NotFound);
}

TEST_F(JobQueueTest, ARunIsOfItsOwnJob) {
  const auto other = add("q.nc").id;
  EXPECT_EQ(start("r1", other).error().code, Errc::Conflict);
  EXPECT_EQ(start("r1", 99).error().code, Errc::NotFound);
  Job job;
  job.machine = "m1";
  job.program = "p.nc";
  job.revision = 7;
  EXPECT_EQ(store_->jobs.add(job, "anna", {}).error().code, Errc::NotFound);
  job.revision = 1;
  const auto pinned = store_->jobs.add(job, "anna", {});
  ASSERT_TRUE(pinned);
  EXPECT_TRUE(start("r1", pinned->id));
  EXPECT_EQ(store_->runs.find("r1")->job, pinned->id);
}

/// A rename takes the jobs of the program with it.
TEST_F(JobQueueTest, FollowsARename) {
  const auto job = add("q.nc").id;
  ASSERT_TRUE(store_->programs.rename({"q.nc", "z.nc", "anna"}));
  EXPECT_EQ(store_->jobs.find(job)->program, "z.nc");
}

}  // namespace
}  // namespace dripline::storage
