#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class ReleaseTest : public ContractTest {
 protected:
  Decision decision(const Revision& revision, RevisionStep step, const std::string& who = "anna") {
    Decision made;
    made.program = revision.program;
    made.revision = revision.number;
    made.content = revision.content;
    made.step = step;
    made.time = clock_.now();
    made.who = {who, "token", "192.0.2.1"};
    made.comment = "why";
    made.policy = sha256("policy");
    made.signature.bytes.fill(std::byte{7});
    return made;
  }
  /// Takes the revision through the steps.
  Revision take(const Revision& revision, const std::vector<RevisionStep>& steps) {
    Revision now = revision;
    for (const auto step : steps) {
      clock_.advance(std::chrono::seconds(1));
      const auto decided = store_->releases.decide(decision(revision, step), now.state);
      EXPECT_TRUE(decided) << decided.error().what;
      if (decided) now = *decided;
    }
    return now;
  }
};

TEST_P(ReleaseTest, ANewRevisionIsADraft) {
  const auto revision = push("p.nc", "M2\n");
  EXPECT_EQ(revision->state, RevisionState::Draft);
  EXPECT_FALSE(revision->released);
  EXPECT_TRUE(store_->releases.decisions("p.nc", 1)->empty());
  EXPECT_EQ(store_->releases.decisions("p.nc", 2).error().code, Errc::NotFound);
}

TEST_P(ReleaseTest, KeepsEveryDecisionAndTheState) {
  const auto revision = push("p.nc", "M2\n");
  using enum RevisionStep;
  const auto released = take(*revision, {Submit, Approve, Release});
  EXPECT_EQ(released.state, RevisionState::Released);
  EXPECT_EQ(released.released, clock_.now());
  EXPECT_EQ(store_->programs.list({})->at(0).released, 1u);
  const auto withdrawn = take(released, {Withdraw});
  EXPECT_EQ(withdrawn.state, RevisionState::Withdrawn);
  EXPECT_FALSE(store_->programs.list({})->at(0).released);
  EXPECT_EQ(withdrawn.released_after, 0u) << "there was no run";
  EXPECT_EQ(withdrawn.withdrawn_after, 0u);
  EXPECT_FALSE(withdrawn.was_released_for(1));
  reopen();
  const auto decisions = store_->releases.decisions("p.nc", 1);
  ASSERT_EQ(decisions->size(), 4u);
  const Decision& approval = decisions->at(1);
  EXPECT_EQ(approval.step, Approve);
  EXPECT_EQ(approval.who.name, "anna");
  EXPECT_EQ(approval.who.credential, "token");
  EXPECT_EQ(approval.who.address, "192.0.2.1");
  EXPECT_EQ(approval.comment, "why");
  EXPECT_EQ(approval.content, revision->content);
  EXPECT_EQ(approval.policy, sha256("policy"));
  EXPECT_EQ(approval.signature.bytes.back(), std::byte{7});
  const auto audited = store_->audit.list({})->at(2);
  EXPECT_EQ(audited.action, "program.approve");
  EXPECT_EQ(audited.detail, fmt::format("revision 1 sha256 {} in_review to approved: why",
                                        revision->content.hex()));
}

/// Two who decide at once: the second one decided about what is not there any more.
TEST_P(ReleaseTest, RefusesADecisionAboutAnotherState) {
  const auto revision = push("p.nc", "M2\n");
  take(*revision, {RevisionStep::Submit});
  const auto again =
      store_->releases.decide(decision(*revision, RevisionStep::Submit), RevisionState::Draft);
  EXPECT_EQ(again.error().code, Errc::Conflict);
  auto other = decision(*revision, RevisionStep::Approve);
  other.content = sha256("other");
  EXPECT_EQ(store_->releases.decide(other, RevisionState::InReview).error().code, Errc::Conflict);
  EXPECT_EQ(store_->releases.decisions("p.nc", 1)->size(), 1u);
}

TEST_P(ReleaseTest, KnowsWhoPushedTheSameBytesUnderAnotherName) {
  const auto revision = push("p.nc", "M2\n");
  ASSERT_TRUE(store_->programs.copy({.from = "p.nc", .to = "q", .who = "bert"}, std::nullopt));
  const auto authors = store_->releases.authors(revision->content);
  EXPECT_EQ(*authors, (std::set<std::string>{revision->author, "bert"}));
  EXPECT_TRUE(store_->releases.authors(sha256("absent"))->empty());
}

TEST_P(ReleaseTest, ARunNamesWhatReleasedItsRevision) {
  Run run = make_run("r1");
  const auto revision = store_->programs.revision("p.nc", 1);
  run.allowed_as = RunAllowance::Released;
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::Conflict) << "it is a draft";
  using enum RevisionStep;
  take(*revision, {Submit, Approve, Release});
  run.approval = store_->releases.decisions("p.nc", 1)->back().id;
  ASSERT_TRUE(store_->runs.create(run));
  EXPECT_EQ(store_->runs.find("r1")->allowed_as, RunAllowance::Released);
  EXPECT_EQ(store_->runs.find("r1")->approval, run.approval);
}

/// The judgment before and the run are two transactions.
TEST_P(ReleaseTest, NoRunBeginsOfWhatWasWithdrawnJustNow) {
  Run run = make_run("r1");
  take(*store_->programs.revision("p.nc", 1), {RevisionStep::Withdraw});
  for (const auto allowance :
       {RunAllowance::Open, RunAllowance::Released, RunAllowance::ProveOut}) {
    run.allowed_as = allowance;
    EXPECT_EQ(store_->runs.create(run).error().code, Errc::Conflict);
  }
}

TEST_P(ReleaseTest, TheSameTextAfterAWithdrawalIsANewDraft) {
  const auto revision = push("p.nc", "M2\n");
  EXPECT_EQ(push("p.nc", "M2\n")->number, 1u);
  take(*revision, {RevisionStep::Withdraw});
  const auto again = push("p.nc", "M2\n");
  EXPECT_EQ(again->number, 2u);
  EXPECT_EQ(again->state, RevisionState::Draft);
}

ON_BOTH_ENGINES(ReleaseTest);

}  // namespace
}  // namespace dripline::storage
