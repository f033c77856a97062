#include "server/library/history/run_facts.hpp"

#include "storage/sqlite/database.hpp"
#include "tests/unit/server/library/release_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::RunState;

class RunFacts : public ReleaseSteps<ServerTest> {
 protected:
  RunFacts() { add_machine("lathe-1"); }
  Result<audit::Attestation> attested(const std::string& run) {
    const auto facts = runs_->facts(run, chain_->header().database);
    if (!facts) return fail(facts.error());
    return audit::parse_attestation(chain_->attest(*facts));
  }
};

TEST_F(RunFacts, NameProgramApprovalAndTheEndInTheTrail) {
  use_policy("runs = \"release\"");
  const auto revision = release("P", "M2\n");
  Run run = run_of(revision, "r1");
  const auto admitted = releases_->admit({.machine = "lathe-1", .program = "P"}).value();
  run.allowed_as = admitted.allowed_as;
  run.approval = admitted.approval;
  ASSERT_TRUE(store_->runs.create(run));
  EXPECT_EQ(attested("r1").error().code, Errc::Conflict) << "it has not ended";
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, "stopped by anna"));
  const auto read = attested("r1");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->value("program"), "P");
  EXPECT_EQ(read->value("sha256"), sha256("M2\n").hex());
  EXPECT_EQ(read->value("state"), "aborted");
  EXPECT_EQ(read->value("reason"), "stopped by anna");
  EXPECT_EQ(read->value("approval_by"), "anna");
  const auto signature = parse_signature(read->value("approval_signature")).value();
  EXPECT_TRUE(is_signed_by(read->key, read->value("approval_text"), signature));
  const auto entries = store_->audit.chained(0, 100).value();
  EXPECT_EQ(read->value("audit_entry"), std::to_string(entries.size()));
  EXPECT_EQ(read->value("audit_sha256"), entries.back().digest.hex());
}

TEST_F(RunFacts, NameTheCalledProgramsAndTheSetupOfTheGateway) {
  const auto called = push("O0002", "M99\n");
  Run run = run_of(push("P", "M98 P2\nM2\n"), "r1");
  run.gateway_setup = sha256("[[tool]]\n").hex();
  ASSERT_TRUE(store_->runs.create(run));
  ASSERT_TRUE(store_->runs.add_call("r1", {"2", "O0002", 1, called.content}));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, ""));
  const auto read = attested("r1");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->value("called_programs"), "1");
  EXPECT_EQ(read->value("called_1"), "2 = O0002 revision 1 sha256 " + sha256("M99\n").hex());
  EXPECT_EQ(read->value("gateway_setup_sha256"), sha256("[[tool]]\n").hex());
  EXPECT_EQ(read->value("setup_sha256"), "") << "the server had none for this machine";
}

TEST_F(RunFacts, OfATestRunAttestNothingAsExecuted) {
  ASSERT_TRUE(store_->runs.create(run_of(push("P", "M2\n"), "r1")));
  storage::RunEnding ending;
  ending.run = "r1";
  ending.state = RunState::Tested;
  ending.reason = "test run: 1 blocks";
  ending.executed_content = sha256("M2\n").hex();
  ending.content_verified = true;
  storage::RecordBatch batch;
  batch.machine = "lathe-1";
  batch.endings.push_back(ending);
  ASSERT_TRUE(store_->records.store(batch));
  const auto read = attested("r1");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->value("state"), "tested");
  EXPECT_EQ(read->value("executed_blocks"), "0");
  EXPECT_EQ(read->value("tested_sha256"), sha256("M2\n").hex());
  EXPECT_EQ(read->value("tested_is_program"), "yes");
  EXPECT_EQ(read->value("executed_sha256"), "");
  EXPECT_EQ(read->value("executed_is_program"), "");
}

/// So that the answer to "what did it call" is never more than a client reads.
TEST_F(RunFacts, OfTheMostCallsFitIntoAnAttestation) {
  const auto name = [](std::size_t i) { return fmt::format("{:0>120}", i); };
  const auto called = push(name(0), "M99\n");
  ASSERT_TRUE(store_->runs.create(run_of(push("P", "M2\n"), "r1")));
  for (std::size_t i = 0; i < storage::RunCall::kMax; ++i)
    ASSERT_TRUE(store_->runs.add_call("r1", {name(i), name(0), 1, called.content}));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, ""));
  const auto read = attested("r1");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->value("called_programs"), std::to_string(storage::RunCall::kMax));
}

TEST_F(RunFacts, AreNotGivenOfARunThatWasChanged) {
  ASSERT_TRUE(store_->runs.create(run_of(push("P", "M2\n"), "r1")));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, ""));
  EXPECT_EQ(attested("r1")->value("allowed_as"), "open");
  auto database = storage::sqlite::Database::open(folder_.path() / "store.sqlite");
  ASSERT_TRUE(database->execute("UPDATE run SET executed = 7"));
  EXPECT_EQ(attested("r1").error().code, Errc::Corrupt);
  EXPECT_EQ(attested("r2").error().code, Errc::NotFound);
}

}  // namespace
}  // namespace dripline::server_test
