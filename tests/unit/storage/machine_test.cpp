#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// The machine m1, with a run r0 that has ended.
class RemovedMachineTest : public ContractTest {
 protected:
  void SetUp() override {
    run_ = make_run("r0");
    ASSERT_TRUE(store_->runs.create(run_));
    ASSERT_TRUE(store_->runs.set_state("r0", RunState::Interrupted, ""));
  }
  Result<void> remove() { return store_->machines.remove("m1", "anna", clock_.now()); }
  std::size_t listed() { return store_->machines.list()->size(); }
  std::size_t runs() {
    RunFilter filter;
    filter.machine = "m1";
    return store_->runs.list(filter, {})->size();
  }
  Run run_;
};

TEST_P(RemovedMachineTest, IsListedNoMore) {
  ASSERT_TRUE(store_->records.store(make_batch(1, 3)));
  ASSERT_TRUE(remove());
  reopen();
  EXPECT_EQ(listed(), 0u);
  const auto entry = store_->audit.list({.limit = 1})->at(0);
  EXPECT_EQ(entry.action, "machine.remove");
  EXPECT_EQ(entry.subject, "m1");
  EXPECT_EQ(remove().error().code, Errc::NotFound);
}

TEST_P(RemovedMachineTest, LosesNothingOfWhatItDid) {
  ASSERT_TRUE(store_->records.store(make_batch(1, 3)));
  ASSERT_TRUE(remove());
  EXPECT_EQ(store_->runs.find("r0")->machine, "m1");
  EXPECT_EQ(runs(), 1u);
  EXPECT_EQ(store_->machines.find("m1")->last_record, 3u);
  EXPECT_EQ(store_->records.store(make_batch(1, 4)), 4u) << "what is on its way is stored too";
  EXPECT_EQ(listed(), 0u);
}

TEST_P(RemovedMachineTest, IsThereAgainWhenItIsSaved) {
  const auto before = store_->machines.find("m1");
  ASSERT_TRUE(remove());
  ASSERT_TRUE(store_->machines.save(*before));
  EXPECT_EQ(store_->machines.list()->at(0).first_seen, before->first_seen);
  EXPECT_EQ(runs(), 1u);
}

TEST_P(RemovedMachineTest, IsNoneWithARunOrAJob) {
  Run run = run_;
  run.id = "r1";
  ASSERT_TRUE(store_->runs.create(run));
  EXPECT_EQ(remove().error().code, Errc::Busy);
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Interrupted, ""));
  Job job;
  job.machine = "m1";
  job.program = "p.nc";
  job.quantity = 1;
  job.author = "anna";
  job.created = clock_.now();
  const auto added = store_->jobs.add(job, "anna", {});
  ASSERT_TRUE(added);
  EXPECT_EQ(remove().error().code, Errc::Conflict);
  EXPECT_EQ(listed(), 1u);
  ASSERT_TRUE(store_->jobs.remove(added->id, "anna", clock_.now()));
  EXPECT_TRUE(remove());
}

ON_BOTH_ENGINES(RemovedMachineTest);

}  // namespace
}  // namespace dripline::storage
