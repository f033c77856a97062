#include <utility>

#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// The job queue of machine m1.
class JobQueueTest : public ContractTest {
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

TEST_P(JobQueueTest, KeepsItsOrderOverMovesAndARestart) {
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

TEST_P(JobQueueTest, CountsPartsOfCompletedRunsOnly) {
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

/// What runs of a job make, measured by templates.
class MeasuredJob : public JobQueueTest {
 protected:
  void SetUp() override {
    JobQueueTest::SetUp();
    for (const char* name : {"bore", "gauge"}) {
      ASSERT_TRUE(store_->report_templates.push(
          {.name = name, .version = 0, .text = "x", .author = "anna", .created = clock_.now()},
          "anna"));
    }
  }
  Job add_good(std::uint64_t quantity, std::uint64_t parts_per_run = 1) {
    Job job;
    job.machine = "m1";
    job.program = "p.nc";
    job.quantity = quantity;
    job.parts_per_run = parts_per_run;
    job.counts = JobCount::Good;
    job.created = clock_.now();
    return *store_->jobs.add(job, "anna", {});
  }
  void part(const std::string& run, measurement::Verdict verdict,
            const std::string& name = "bore") {
    DerivedBatch batch;
    batch.machine = "m1";
    batch.epoch = 99;
    batch.after = std::exchange(through_, through_ + 1);
    batch.through = through_;
    MeasuredPart one;
    one.id = *store_->measurements.next_part_id();
    one.machine = "m1";
    one.run = run;
    one.template_name = name;
    one.template_version = 1;
    one.verdict = verdict;
    one.begun = clock_.now();
    one.ended = clock_.now();
    batch.parts = {one};
    const auto done = store_->measurements.commit(batch);
    ASSERT_TRUE(done) << done.error().what;
  }
  /// A run of the job that makes parts with these verdicts.
  void make(const std::string& id, std::uint64_t job,
            const std::vector<measurement::Verdict>& verdicts,
            RunState state = RunState::Completed) {
    const auto started = start(id, job);
    ASSERT_TRUE(started) << started.error().what;
    for (const auto verdict : verdicts) part(id, verdict);
    end(id, state);
  }
  std::string counts(std::uint64_t id) {
    const auto job = store_->jobs.find(id);
    const auto listed = store_->jobs.list("m1", true, {});
    if (!listed->empty()) {
      EXPECT_EQ(listed->front().scrap, job->scrap);
    }
    return fmt::format("{} made: {} good {} unknown, {} rework {} scrap, {} counted",
                       job->completed, job->good, job->unknown, job->rework, job->scrap,
                       job->counted);
  }
  std::uint64_t through_ = 0;
};
using enum measurement::Verdict;

TEST_P(MeasuredJob, ShowsWhatWasMadeByVerdictAndCountsAllOfIt) {
  const auto job = add("p.nc", 4).id;
  make("r1", job, {Good});
  make("r2", job, {Rework});
  make("r3", job, {Scrap});
  EXPECT_EQ(counts(job), "3 made: 1 good 0 unknown, 1 rework 1 scrap, 3 counted");
  make("r4", job, {});
  EXPECT_EQ(counts(job), "4 made: 1 good 1 unknown, 1 rework 1 scrap, 4 counted");
  EXPECT_EQ(store_->jobs.find(job)->state, JobState::Done);
}

TEST_P(MeasuredJob, ThatCountsGoodPartsIsDoneWithThem) {
  const auto job = add_good(2).id;
  EXPECT_EQ(store_->audit.list({.limit = 1})->at(0).detail, "job 1: p.nc, 2 good parts");
  make("r1", job, {Good});
  make("r2", job, {Scrap});
  make("r3", job, {});
  EXPECT_EQ(counts(job), "3 made: 1 good 1 unknown, 0 rework 1 scrap, 1 counted");
  EXPECT_EQ(store_->jobs.find(job)->state, JobState::Waiting);
  EXPECT_EQ(store_->jobs.next("m1").value()->id, job);
  reopen();
  make("r4", job, {Good});
  EXPECT_EQ(store_->jobs.find(job)->state, JobState::Done);
  EXPECT_EQ(store_->jobs.next("m1").value(), std::nullopt);
  const auto more = start("r5", job);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().what, fmt::format("job {} is done", job));
}

/// Held for scrap, then aborted: no part was made, and the scrap is not hidden.
TEST_P(MeasuredJob, ScrapOfARunThatWasCutOffIsShown) {
  const auto job = add_good(1).id;
  make("r1", job, {Scrap}, RunState::Aborted);
  EXPECT_EQ(counts(job), "0 made: 0 good 0 unknown, 0 rework 1 scrap, 0 counted");
  make("r2", job, {Good}, RunState::Aborted);
  EXPECT_EQ(counts(job), "0 made: 0 good 0 unknown, 0 rework 1 scrap, 0 counted");
}

TEST_P(MeasuredJob, APartThatTwoTemplatesMeasureIsOneAndGoodForBoth) {
  const auto job = add_good(3).id;
  make("r1", job, {Good});
  part("r1", Good, "gauge");
  EXPECT_EQ(counts(job), "1 made: 1 good 0 unknown, 0 rework 0 scrap, 1 counted");
  make("r2", job, {Good});
  part("r2", Scrap, "gauge");
  EXPECT_EQ(counts(job), "2 made: 1 good 0 unknown, 0 rework 1 scrap, 1 counted");
}

TEST_P(MeasuredJob, ARunMakesNoMoreGoodPartsThanItMakes) {
  const auto job = add_good(8, 2).id;
  make("r1", job, {Good, Good, Good});
  EXPECT_EQ(counts(job), "2 made: 2 good 0 unknown, 0 rework 0 scrap, 2 counted");
  make("r2", job, {Good});
  EXPECT_EQ(counts(job), "4 made: 3 good 1 unknown, 0 rework 0 scrap, 3 counted");
}

/// Which of the parts that it reports is the workpiece is not known: in doubt one more is made.
TEST_P(MeasuredJob, ARunThatReportsMoreThanItMakesHasFewerGoodOnes) {
  const auto job = add_good(8).id;
  make("r1", job, {Good, Scrap});
  make("r2", job, {Rework, Good});
  make("r3", job, {Unknown, Good, Good});
  EXPECT_EQ(store_->jobs.find(job)->counted, 0u);
  make("r4", job, {Good, Good});
  EXPECT_EQ(store_->jobs.find(job)->counted, 1u);
}

TEST_P(MeasuredJob, ArchivedPartsStillCount) {
  const auto job = add_good(3).id;
  make("r1", job, {Good});
  make("r2", job, {Scrap});
  const auto archive = store_->archives.add({.kind = ArchiveKind::Measurements,
                                             .first = 1,
                                             .last = 2,
                                             .file = "measurements-1.jsonl.zst",
                                             .created = clock_.now()},
                                            "retention");
  while (*store_->archives.remove_rows(*archive, 10) > 0) {
  }
  ASSERT_TRUE(store_->measurements.parts({}, {})->empty());
  EXPECT_EQ(counts(job), "2 made: 1 good 0 unknown, 0 rework 1 scrap, 1 counted");
}

/// The end of a run counts once, however often its record is sent.
TEST_P(JobQueueTest, CountsAnEndingOnce) {
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

TEST_P(JobQueueTest, SeveralPartsPerRun) {
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

TEST_P(JobQueueTest, AHeldQueueStartsNothing) {
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

TEST_P(JobQueueTest, ARunIsOfItsOwnJob) {
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
TEST_P(JobQueueTest, FollowsARename) {
  const auto job = add("q.nc").id;
  ASSERT_TRUE(store_->programs.rename({"q.nc", "z.nc", "anna"}));
  EXPECT_EQ(store_->jobs.find(job)->program, "z.nc");
}

ON_BOTH_ENGINES(JobQueueTest);
ON_BOTH_ENGINES(MeasuredJob);

}  // namespace
}  // namespace dripline::storage
