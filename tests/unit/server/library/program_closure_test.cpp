// A program with all it calls: which revisions these are, what is missing, and that a release pins
// them.
#include "server/library/program_closure.hpp"

#include "gateway/interpreter/core/called_program_names.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/server/library/release_fixture.hpp"

namespace dripline::server_test {
namespace {

using library::Closure;
using library::ClosureRequest;
using storage::RevisionState;
using storage::RevisionStep;
using storage::Role;
using storage::RunAllowance;

class ClosureTest : public ReleaseSteps<ServerTest> {
 protected:
  Result<Closure> closure(const std::string& program, std::uint64_t revision = 1,
                          std::vector<ClosureRequest::Named> named = {}) {
    return releases_->closure({.main = programs_->revision(program, revision).value(),
                               .machine = machine_,
                               .named = std::move(named)});
  }
  /// "O0200@1 O0300@2 !O0400 ?".
  std::string words(const Result<Closure>& found) {
    if (!found) return found.error().what;
    std::string text;
    for (const auto& called : found->called)
      text += fmt::format("{}@{} ", called.revision.program, called.revision.number);
    for (const auto& missing : found->missing) text += "!" + missing.name + " ";
    for (std::size_t i = 0; i < found->computed.size(); ++i) text += "? ";
    if (!text.empty()) text.pop_back();
    return text;
  }
  void approve(const std::string& program, std::uint64_t revision = 1) {
    decide(program, revision, RevisionStep::Submit);
    decide(program, revision, RevisionStep::Approve);
  }
  Result<storage::Revision> release_all(const std::string& program, std::uint64_t revision = 1,
                                        std::vector<ClosureRequest::Named> named = {},
                                        const std::string& who = "anna") {
    auto found = closure(program, revision, std::move(named));
    if (!found) return fail(found.error());
    return releases_->decide({.program = program,
                              .revision = revision,
                              .step = RevisionStep::Release,
                              .comment = {},
                              .who = {who, "token", "192.0.2.1"},
                              .role = Role::Approver,
                              .closure = *std::move(found)});
  }
  Run run_of_now(const std::string& program) {
    const auto admitted = releases_->admit({.machine = "lathe-1", .program = program});
    EXPECT_TRUE(admitted) << admitted.error().what;
    Run run = run_of(admitted->revision, "run-1");
    run.allowed_as = admitted->allowed_as;
    run.approval = admitted->approval;
    return run;
  }
  std::string called(const Run& run, const std::string& name) {
    const auto found = releases_->pinned_call(run, interpreter::called_program_names(name));
    if (!found) return found.error().what;
    return *found ? fmt::format("{}@{}", (*found)->program, (*found)->number) : "not pinned";
  }
  void change(const std::string& sql) {
    auto database = storage::sqlite::Database::open(folder_.path() / "store.sqlite");
    ASSERT_TRUE(database) << database.error().what;
    const auto done = database->execute(sql);
    ASSERT_TRUE(done) << done.error().what;
  }
  /// O0100 calls O0200, which calls O0300 (kept as O300.nc).
  void push_three() {
    push("O0100", "O0100\nM98 P200\nM30\n");
    push("O0200", "O0200\nM98 P300\nM99\n");
    push("O300.nc", "O0300\nM99\n");
  }

  std::string machine_;
};

TEST_F(ClosureTest, IsWhatARunWouldGetNow) {
  push_three();
  EXPECT_EQ(words(closure("O0100")), "O0200@1 O300.nc@1");
  EXPECT_EQ(words(closure("O300.nc")), "");
  push("O0200", "O0200\nM98 P400\nM99\n");
  EXPECT_EQ(words(closure("O0100")), "O0200@2 !O0400") << "the newest in force";
  push("O0400", "%2 CALL\n", "tnc155");
  EXPECT_EQ(words(closure("O0100")), "O0200@2 !O0400") << "one for another control";
  decide("O0200", 2, RevisionStep::Withdraw);
  EXPECT_EQ(words(closure("O0100")), "O0200@1 O300.nc@1");
  use_policy("runs = \"release\"");
  push("O0200", "O0200\nM99\n");
  EXPECT_EQ(words(closure("O0100")), "O0200@3") << "without a released one, the newest in force";
  take_to_release("O0200", 1);
  EXPECT_EQ(words(closure("O0100")), "O0200@1 O300.nc@1") << "the newest that is released";
}

TEST_F(ClosureTest, NamesWhereSomethingIsMissingOrComputed) {
  push("O0100", "O0100\nG1 X1.\nM98 P200\nCALL [P5]\nM30\n");
  const auto found = closure("O0100");
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_EQ(words(found), "!O0200 ?");
  EXPECT_EQ(found->missing[0].site.line, 3u);
  EXPECT_EQ(found->computed[0].line, 4u);
  approve("O0100");
  const auto missing = release_all("O0100");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().what,
            "program O0100 revision 1 is not released: it calls what is not in the library for "
            "control centurion: 'O0200' (line 3 of O0100 revision 1)");
  push("O0200", "O0200\nM99\n");
  approve("O0200");
  const auto computed = release_all("O0100");
  ASSERT_FALSE(computed);
  EXPECT_NE(computed.error().what.find("line 4 of O0100 revision 1 computes"), std::string::npos);
  push("O0500", "O0500\nM99\n");
  approve("O0500");
  ASSERT_TRUE(release_all("O0100", 1, {{"O0500", {}}}));
  EXPECT_EQ(programs_->revision("O0500", 1)->state, RevisionState::Released);
}

TEST_F(ClosureTest, EndsWhereProgramsCallEachOther) {
  push("O0100", "O0100\nM98 P200\nM30\n");
  push("O0200", "O0200\nM98 P100\nM98 P200\nM99\n");
  EXPECT_EQ(words(closure("O0100")), "O0200@1") << "O0100 is in the text that is started";
  approve("O0100");
  approve("O0200");
  ASSERT_TRUE(release_all("O0100"));
}

TEST_F(ClosureTest, TakesTheSetupsOfAMachineForBoundCodes) {
  push("O0100", "O0100\nG100\nM30\n");
  push("O9010", "O9010\nM99\n");
  EXPECT_EQ(words(closure("O0100")), "");
  add_machine("lathe-1");
  machine_ = "lathe-1";
  EXPECT_EQ(closure("O0100").error().code, Errc::NotFound) << "it has no setup";
  ASSERT_TRUE(setups_->save({.machine = "lathe-1",
                             .control = "centurion",
                             .text = "control.custom_g = [100]\n",
                             .comment = {}},
                            "anna"));
  EXPECT_EQ(words(closure("O0100")), "O9010@1");
  push("RAM-O9010", "O9010\nG4 P1\nM99\n");
  EXPECT_EQ(words(closure("O0100")), "RAM-O9010@1") << "that directory comes first";
}

TEST_F(ClosureTest, AReleaseWithItReleasesAllOrNothing) {
  use_policy("runs = \"release\"\n[release]\nfour_eyes = true\n");
  push_three();
  approve("O0100");
  approve("O0200");
  EXPECT_NE(release_all("O0100").error().what.find("O300.nc revision 1 is draft"),
            std::string::npos);
  approve("O300.nc");
  EXPECT_EQ(release_all("O0100", 1, {}, "cam").error().code, Errc::Denied)
      << "who pushed them does not release them";
  EXPECT_EQ(programs_->revision("O0200", 1)->state, RevisionState::Approved);
  EXPECT_EQ(programs_->revision("O0100", 1)->state, RevisionState::Approved);
  const auto released = release_all("O0100");
  ASSERT_TRUE(released) << released.error().what;
  EXPECT_EQ(released->program, "O0100");
  for (const std::string program : {"O0100", "O0200", "O300.nc"})
    EXPECT_EQ(programs_->revision(program, 1)->state, RevisionState::Released) << program;
  const auto decisions = releases_->decisions("O0100", 1).value();
  ASSERT_TRUE(decisions.back().closure);
  ASSERT_EQ(decisions.back().closure->size(), 2u);
  EXPECT_EQ(decisions.back().closure->at(1).program, "O300.nc");
  const std::string text = releases_->text_of(decisions.back());
  EXPECT_NE(text.find("closure 2\ncalls O0200 1 "), std::string::npos) << text;
  EXPECT_TRUE(is_signed_by(releases_->public_key(), text, decisions.back().signature));
  const auto entry = store_->audit.list({.limit = 1, .offset = 0}).value().front();
  EXPECT_NE(entry.detail.find("pins O0200@1, O300.nc@1"), std::string::npos) << entry.detail;
}

TEST_F(ClosureTest, ALaterRevisionNeverChangesWhatWasApproved) {
  for (const std::string policy : {"runs = \"release\"", ""}) {
    use_policy(policy);
    const std::string main = policy.empty() ? "O0101" : "O0100";
    push(main, fmt::format("{}\nM98 P200\nM30\n", main));
    push("O0200", "O0200\nM98 P300\nM99\n");
    push("O300.nc", "O0300\nM99\n");
    for (const std::string& program : {main, std::string("O0200"), std::string("O300.nc")}) {
      if (programs_->revision(program, {})->state == RevisionState::Draft)
        approve(program, programs_->revision(program, {})->number);
    }
    ASSERT_TRUE(release_all(main)) << policy;
    const auto pins = *releases_->decisions(main, 1)->back().closure;
    const auto pinned = [&](std::size_t i) {
      return fmt::format("{}@{}", pins.at(i).program, pins.at(i).revision);
    };
    release("O0200", "O0200\nG1 X99.\nM99\n" + policy);
    release("O0300", "O0300\nG1 X99.\nM99\n" + policy);
    clock_.advance(std::chrono::seconds(1));
    const Run run = run_of_now(main);
    EXPECT_EQ(run.allowed_as, policy.empty() ? RunAllowance::Open : RunAllowance::Released);
    EXPECT_EQ(called(run, "O0200"), pinned(0));
    EXPECT_EQ(called(run, "O0300"), pinned(1)) << "under the name it was found under";
    EXPECT_EQ(called(run, "O0400"),
              fmt::format("program {} revision 1 was released without a program 'O0400'", main));
  }
}

TEST_F(ClosureTest, PinsOutliveANewNameAndARemovalOfTheProgram) {
  use_policy("runs = \"release\"");
  push_three();
  for (const std::string program : {"O0100", "O0200", "O300.nc"}) approve(program);
  ASSERT_TRUE(release_all("O0100"));
  ASSERT_TRUE(programs_->rename({.from = "O0200", .to = "O0210", .who = {"anna", "", ""}}));
  ASSERT_TRUE(programs_->remove("O300.nc", {"anna", "", ""}));
  release("O0200", "O0200\nG1 X99.\nM99\n");
  clock_.advance(std::chrono::seconds(1));
  const Run run = run_of_now("O0100");
  EXPECT_EQ(called(run, "O0200"), "O0210@1");
  EXPECT_EQ(called(run, "O0300"), "O300.nc@1");
}

TEST_F(ClosureTest, AWithdrawnSubprogramStopsItsCallersFromNowOn) {
  use_policy("runs = \"release\"");
  push_three();
  for (const std::string program : {"O0100", "O0200", "O300.nc"}) approve(program);
  ASSERT_TRUE(release_all("O0100"));
  clock_.advance(std::chrono::seconds(1));
  Run run = run_of_now("O0100");
  add_machine("lathe-1");
  clock_.advance(std::chrono::seconds(1));
  decide("O300.nc", 1, RevisionStep::Withdraw);
  EXPECT_EQ(called(run, "O0300"), "O300.nc@1") << "a run keeps what it began with";
  const auto refused = releases_->admit({.machine = "lathe-1", .program = "O0100"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "program O0100 revision 1 calls O300.nc revision 1, which was withdrawn");
  // It was withdrawn between the two: the run is not created.
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::Conflict);
}

TEST_F(ClosureTest, APinThatWasChangedInTheDatabaseRunsNothing) {
  use_policy("runs = \"release\"");
  push_three();
  for (const std::string program : {"O0100", "O0200", "O300.nc"}) approve(program);
  ASSERT_TRUE(release_all("O0100"));
  release("O0200", "O0200\nG1 X99.\nM99\n");
  clock_.advance(std::chrono::seconds(1));
  ASSERT_TRUE(releases_->admit({.machine = "lathe-1", .program = "O0100"}));
  const std::string where = " WHERE name = 'O0200'";
  for (const std::string& sql :
       {"UPDATE revision_pin SET revision = 2, sha256 = (SELECT sha256 FROM revision WHERE number "
        "= 2)" +
            where,
        "UPDATE revision_pin SET revision = 2" + where, "DELETE FROM revision_pin" + where,
        "UPDATE revision_pin SET name = 'O0999'" + where,
        std::string("UPDATE revision_step SET closure = NULL"),
        std::string("UPDATE revision_step SET closure = 0 WHERE closure IS NOT NULL; DELETE FROM "
                    "revision_pin")}) {
    const auto saved =
        store_->copy_to(folder_.path() / "saved.sqlite", [](auto, auto) { return true; });
    ASSERT_TRUE(saved);
    change(sql);
    EXPECT_EQ(releases_->admit({.machine = "lathe-1", .program = "O0100"}).error().code,
              Errc::Corrupt)
        << sql;
    store_.reset();
    for (const char* rest : {"", "-wal", "-shm"})
      std::filesystem::remove(folder_.path() / (std::string("store.sqlite") + rest));
    std::filesystem::copy_file(folder_.path() / "saved.sqlite", folder_.path() / "store.sqlite");
    reopen();
    use_policy("runs = \"release\"");
  }
}

}  // namespace
}  // namespace dripline::server_test
