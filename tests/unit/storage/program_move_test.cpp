#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

/// CEN-211: programs copied and renamed.
class ProgramMoveTest : public ContractTest {
 protected:
  Result<Revision> copy(const std::string& from, const std::string& to,
                        std::optional<std::uint64_t> number = std::nullopt) {
    return store_->programs.copy({.from = from, .to = to, .who = "cam"}, number);
  }
  Result<void> rename(const std::string& from, const std::string& to) {
    return store_->programs.rename({.from = from, .to = to, .who = "cam"});
  }
  Result<Revision> receive(const std::string& program, std::string_view text) {
    Upload upload;
    upload.program = program;
    upload.is_held = true;
    const auto begun = store_->uploads.begin(upload);
    EXPECT_TRUE(begun && store_->uploads.append(begun->id, 0, bytes_of(text)));
    return store_->uploads.commit(begun->id, std::nullopt);
  }
  AuditEntry last_entry() { return store_->audit.list({})->at(0); }
};

template <class T>
void expect_refused(const Result<T>& result, Errc code, const std::string& words) {
  ASSERT_FALSE(result) << words;
  EXPECT_EQ(result.error().code, code) << result.error().what;
  EXPECT_NE(result.error().what.find(words), std::string::npos) << result.error().what;
}

TEST_P(ProgramMoveTest, ACopyBeginsWithTheLatestRevision) {
  ASSERT_TRUE(push("O1", "G0 X1\n"));
  ASSERT_TRUE(push("O1", "G0 X2\n"));
  const auto made = copy("O1", "O2");
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_EQ(made->program, "O2");
  EXPECT_EQ(made->number, 1u);
  EXPECT_EQ(made->comment, "copy of O1 revision 2");
  EXPECT_EQ(made->author, "cam");
  EXPECT_EQ(pull(made->content), "G0 X2\n");
  EXPECT_EQ(store_->programs.revisions("O1")->size(), 2u) << "what was copied stays";
  EXPECT_EQ(last_entry().action, "program.copy");
  EXPECT_EQ(last_entry().subject, "O2");
  EXPECT_EQ(last_entry().who.name, "cam");
  const auto old = copy("O1", "O3", 1);
  ASSERT_TRUE(old);
  EXPECT_EQ(pull(old->content), "G0 X1\n");
  // Each has its content, whatever becomes of the other.
  ASSERT_TRUE(store_->programs.remove("O1"));
  reopen();
  EXPECT_EQ(pull(store_->programs.revision("O2", std::nullopt)->content), "G0 X2\n");
}

TEST_P(ProgramMoveTest, ARenameKeepsRevisionsAndRuns) {
  const auto run = make_run("r1");
  ASSERT_TRUE(store_->runs.create(run));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Completed, ""));
  ASSERT_TRUE(push(run.program, "G0 X2\n"));
  ASSERT_TRUE(rename(run.program, "O0077"));
  reopen();
  expect_refused(store_->programs.revisions(run.program), Errc::NotFound, run.program);
  const auto revisions = store_->programs.revisions("O0077");
  ASSERT_TRUE(revisions);
  ASSERT_EQ(revisions->size(), 2u);
  EXPECT_EQ(revisions->at(1).content, run.content);
  EXPECT_EQ(store_->runs.find("r1")->program, "O0077");
  EXPECT_EQ(last_entry().action, "program.rename");
  EXPECT_EQ(last_entry().subject, "O0077");
  EXPECT_EQ(last_entry().detail, "was p.nc, with 2 revisions");
  EXPECT_EQ(push("O0077", "G0 X3\n")->number, 3u) << "numbers go on";
  EXPECT_EQ(push(run.program, "G0 X4\n")->number, 1u) << "the old name is free";
}

TEST_P(ProgramMoveTest, RefusesANameThatExists) {
  ASSERT_TRUE(push("O1", "G0 X1\n"));
  ASSERT_TRUE(push("O2", "G0 X2\n"));
  expect_refused(copy("O1", "O2"), Errc::Conflict, "program O2 exists already, with 1 revision");
  expect_refused(rename("O1", "O2"), Errc::Conflict, "program O2 exists already");
  expect_refused(copy("O1", "O1"), Errc::Conflict, "O1 cannot be copied to itself");
  expect_refused(rename("O1", "O1"), Errc::Conflict, "O1 cannot be renamed to itself");
  expect_refused(copy("O1", "../O3"), Errc::Syntax, "../O3");
  expect_refused(rename("O1", ""), Errc::Syntax, "name");
  expect_refused(copy("O9", "O3"), Errc::NotFound, "O9");
  expect_refused(rename("O9", "O3"), Errc::NotFound, "O9");
  expect_refused(copy("O1", "O3", 7), Errc::NotFound, "no revision 7");
  EXPECT_EQ(store_->programs.list({})->size(), 2u);
  EXPECT_TRUE(store_->audit.list({})->empty());
}

TEST_P(ProgramMoveTest, RefusesToRenameWhatARunUses) {
  const auto run = make_run("r1");
  ASSERT_TRUE(store_->runs.create(run));
  expect_refused(rename(run.program, "O2"), Errc::Busy, "run r1 on m1");
  EXPECT_TRUE(copy(run.program, "O2")) << "a copy touches no run";
}

TEST_P(ProgramMoveTest, RefusesWhatWaitsForAcceptance) {
  ASSERT_TRUE(receive("O1", "G0 X1\n"));
  expect_refused(copy("O1", "O2"), Errc::Conflict, "waits for acceptance");
  expect_refused(copy("O1", "O2", 1), Errc::Conflict, "revision 1 waits for acceptance");
  expect_refused(rename("O1", "O2"), Errc::Conflict, "revision 1");
  ASSERT_TRUE(store_->programs.accept("O1", 1, "cam"));
  EXPECT_TRUE(copy("O1", "O2"));
  EXPECT_TRUE(rename("O1", "O3"));
}

TEST_P(ProgramMoveTest, LeavesTheNameOfARemovedProgramToItsRuns) {
  ASSERT_TRUE(push("O1", "G0 X1\n"));
  ASSERT_TRUE(push("O2", "G0 X2\n"));
  ASSERT_TRUE(store_->programs.remove("O2"));
  expect_refused(rename("O1", "O2"), Errc::Conflict, "O2 was removed");
  const auto made = copy("O1", "O2");
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_EQ(made->number, 2u) << "as a program that is pushed again";
}

ON_BOTH_ENGINES(ProgramMoveTest);

}  // namespace
}  // namespace dripline::storage
