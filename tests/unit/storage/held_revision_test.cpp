#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// What an operator punched out at a control.
class HeldRevision : public ContractTest {
 protected:
  Result<Revision> receive(const std::string& program, std::string_view text) {
    Upload upload;
    upload.program = program;
    upload.author = "machine lathe-2";
    upload.is_held = true;
    const auto begun = store_->uploads.begin(upload);
    if (!begun) return fail(begun.error());
    if (auto put = store_->uploads.append(begun->id, 0, bytes_of(text)); !put) {
      return fail(put.error());
    }
    return store_->uploads.commit(begun->id, sha256(text));
  }
};

TEST_P(HeldRevision, IsListedAndReadableButNeverTheLatest) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  const auto held = receive("p.nc", "G00 X1.1\n");
  ASSERT_TRUE(held) << held.error().what;
  EXPECT_TRUE(held->is_held);
  EXPECT_EQ(held->number, 2u);
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 1u);
  EXPECT_TRUE(store_->programs.revision("p.nc", 2)->is_held);
  EXPECT_EQ(store_->programs.revisions("p.nc")->front().number, 2u);
  EXPECT_EQ(pull(held->content), "G00 X1.1\n");
  const auto listed = store_->programs.list({})->at(0);
  EXPECT_EQ(listed.latest.number, 1u);
  EXPECT_EQ(listed.revisions, 2u);
  EXPECT_EQ(listed.held, 1u);
}

TEST_P(HeldRevision, AloneInItsProgramIsListedWithWhatToDo) {
  ASSERT_TRUE(receive("O0012", "G00 X1.\n"));
  const auto listed = store_->programs.list({});
  ASSERT_EQ(listed->size(), 1u);
  EXPECT_TRUE(listed->at(0).latest.is_held);
  const auto latest = store_->programs.revision("O0012", std::nullopt);
  ASSERT_FALSE(latest);
  EXPECT_EQ(latest.error().code, Errc::Conflict);
  EXPECT_EQ(latest.error().what,
            "program O0012 came from a machine and waits for acceptance: accept its revision 1 "
            "first");
  ASSERT_TRUE(store_->programs.remove("O0012"));
  EXPECT_TRUE(store_->programs.list({})->empty());
}

TEST_P(HeldRevision, DoesNotRunBeforeItIsAccepted) {
  auto run = make_run("r1");
  const auto held = receive("p.nc", "G00 X9.\n");
  run.revision = held->number;
  run.content = held->content;
  const auto refused = store_->runs.create(run);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("p.nc revision 2"), std::string::npos);
  EXPECT_NE(refused.error().what.find("accept"), std::string::npos);
  EXPECT_FALSE(store_->runs.find("r1"));
  ASSERT_TRUE(store_->programs.accept("p.nc", 2, "boss"));
  EXPECT_TRUE(store_->runs.create(run));
}

TEST_P(HeldRevision, AcceptedIsInForceFromThenOnAndWrittenDown) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  ASSERT_TRUE(receive("p.nc", "G00 X1.1\n"));
  const UtcTime received = clock_.now();
  clock_.advance(std::chrono::seconds(60));
  const auto accepted = store_->programs.accept("p.nc", 2, "boss");
  ASSERT_TRUE(accepted) << accepted.error().what;
  EXPECT_FALSE(accepted->is_held);
  EXPECT_EQ(accepted->created, received);
  EXPECT_EQ(accepted->accepted, clock_.now());
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 2u);
  EXPECT_EQ(store_->programs.list({})->at(0).held, 0u);
  const auto entry = store_->audit.list({})->at(0);
  EXPECT_EQ(entry.action, "program.accept");
  EXPECT_EQ(entry.who.name, "boss");
  EXPECT_EQ(entry.subject, "p.nc");
  EXPECT_EQ(entry.detail, "revision 2 sha256 " + accepted->content.hex());
  EXPECT_TRUE(store_->programs.accept("p.nc", 2, "boss")) << "twice is no harm";
  EXPECT_EQ(store_->audit.list({})->size(), 1u);
  EXPECT_EQ(store_->programs.accept("p.nc", 7, "boss").error().code, Errc::NotFound);
}

TEST_P(HeldRevision, AcceptedLateDoesNotOvertakeANewerOne) {
  ASSERT_TRUE(receive("p.nc", "G00 X1.1\n"));
  ASSERT_TRUE(push("p.nc", "G00 X2.\n"));
  ASSERT_TRUE(store_->programs.accept("p.nc", 1, "boss"));
  EXPECT_EQ(store_->programs.revision("p.nc", std::nullopt)->number, 2u);
}

TEST_P(HeldRevision, RejectedIsHiddenForEverAndItsNumberIsNotUsedAgain) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  ASSERT_TRUE(receive("p.nc", "G00 X1.1\n"));
  const auto rejected = store_->programs.reject("p.nc", 2, "boss");
  ASSERT_TRUE(rejected) << rejected.error().what;
  EXPECT_EQ(store_->programs.revisions("p.nc")->size(), 1u);
  EXPECT_EQ(store_->programs.revision("p.nc", 2).error().code, Errc::NotFound);
  EXPECT_EQ(store_->programs.accept("p.nc", 2, "boss").error().code, Errc::NotFound);
  EXPECT_EQ(store_->audit.list({})->at(0).action, "program.reject");
  EXPECT_EQ(receive("p.nc", "G00 X1.1\n")->number, 3u);
  const auto in_force = store_->programs.reject("p.nc", 1, "boss");
  EXPECT_EQ(in_force.error().code, Errc::Conflict);
  EXPECT_TRUE(store_->programs.revision("p.nc", 1));
}

TEST_P(HeldRevision, WhatIsThereAlreadyIsNotReceivedTwice) {
  ASSERT_TRUE(push("p.nc", "G00 X1.\n"));
  const auto same_as_latest = receive("p.nc", "G00 X1.\n");
  EXPECT_EQ(same_as_latest->number, 1u);
  EXPECT_FALSE(same_as_latest->is_held);
  EXPECT_EQ(receive("p.nc", "G00 X3.\n")->number, 2u);
  EXPECT_EQ(receive("p.nc", "G00 X3.\n")->number, 2u);
  const auto pushed = push("p.nc", "G00 X3.\n");
  EXPECT_EQ(pushed->number, 3u) << "a push is in force at once, whatever waits";
  EXPECT_FALSE(pushed->is_held);
}

TEST_P(HeldRevision, SurvivesARestartOfTheServerInTheMiddle) {
  Upload upload;
  upload.program = "p.nc";
  upload.is_held = true;
  const auto begun = store_->uploads.begin(upload);
  ASSERT_TRUE(store_->uploads.append(begun->id, 0, bytes_of("M30\n")));
  reopen();
  EXPECT_TRUE(store_->uploads.find(begun->id)->is_held);
  EXPECT_TRUE(store_->uploads.commit(begun->id, std::nullopt)->is_held);
  reopen();
  EXPECT_TRUE(store_->programs.revision("p.nc", 1)->is_held);
}

ON_BOTH_ENGINES(HeldRevision);

}  // namespace
}  // namespace dripline::storage
