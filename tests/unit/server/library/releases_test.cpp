#include "server/library/releases.hpp"

#include "storage/sqlite/database.hpp"
#include "tests/unit/server/library/release_fixture.hpp"

namespace dripline::server_test {
namespace {

using library::Releases;
using storage::RevisionState;
using storage::RevisionStep;
using storage::Role;
using storage::RunAllowance;

class ReleasesTest : public ReleaseSteps<ServerTest> {
 protected:
  Result<Releases::Admission> admit(const std::string& program,
                                    std::optional<std::uint64_t> revision = {},
                                    Role role = Role::Viewer,
                                    const std::string& machine = "lathe-1") {
    return releases_->admit(
        {.machine = machine, .program = program, .revision = revision, .role = role});
  }
  void change(const std::string& sql) {
    auto database = storage::sqlite::Database::open(folder_.path() / "store.sqlite");
    ASSERT_TRUE(database) << database.error().what;
    const auto done = database->execute(sql);
    ASSERT_TRUE(done) << done.error().what;
  }
};

TEST_F(ReleasesTest, OpenTakesWhatWasPushedButNotWhatWasWithdrawn) {
  push("P", "M2\n");
  push("P", "M3\n");
  const auto admitted = admit("P");
  ASSERT_TRUE(admitted) << admitted.error().what;
  EXPECT_EQ(admitted->revision.number, 2u);
  EXPECT_EQ(admitted->allowed_as, RunAllowance::Open);
  EXPECT_FALSE(admitted->approval);
  decide("P", 2, RevisionStep::Withdraw);
  EXPECT_EQ(admit("P")->revision.number, 1u);
  EXPECT_EQ(admit("P", 2).error().what, "program P revision 2 is withdrawn");
  decide("P", 1, RevisionStep::Withdraw);
  EXPECT_EQ(admit("P").error().code, Errc::Conflict);
}

/// A control takes the numbers of such a text for other parameters of its own.
TEST_F(ReleasesTest, ParametersInOurOwnNumbersAreForNoMachine) {
  const std::string mark = "(DRIPLINE'S OWN NUMBERS OF PARAMETERS: NOT FOR A CONTROL)\n";
  push("P", mark + "G21\nG10\nP500=1\nG11\nM30\n");
  EXPECT_EQ(admit("P").error().code, Errc::Unsupported);
  EXPECT_EQ(admit("P").error().what,
            "program P revision 1 has parameters in Dripline's own numbers, which a control takes "
            "for others: it is not sent to a machine. Write it with the numbers of the control's "
            "builder (dnc setup export MACHINE --map FILE)");
  const auto listed = store_->programs.list({.limit = 10});
  ASSERT_TRUE(listed);
  EXPECT_FALSE(releases_->offered(listed->front(), "lathe-1"));
  push("P", "%\nO9990\n(BY HAND)\n( dripline s own numbers of parameters : not for a control )\n");
  EXPECT_FALSE(admit("P")) << "changed by an editor";
  push("P", "(DRIPLINE WROTE THIS)\nM30\n");
  EXPECT_TRUE(admit("P"));
  EXPECT_TRUE(releases_->offered(store_->programs.list({.limit = 10})->front(), "lathe-1"));
  take_to_release("P", 3);
  EXPECT_FALSE(admit("P", 1)) << "the verdict on a content is remembered, not on a name";
}

TEST_F(ReleasesTest, ReleaseTakesTheLatestThatIsReleasedAndSaysWhyNot) {
  use_policy("runs = \"release\"");
  push("P", "M2\n");
  EXPECT_EQ(admit("P").error().what,
            "program P revision 1 is draft: machine 'lathe-1' runs released revisions only");
  decide("P", 1, RevisionStep::Submit);
  EXPECT_NE(admit("P", 1).error().what.find("is in review"), std::string::npos);
  decide("P", 1, RevisionStep::Approve);
  EXPECT_FALSE(admit("P"));
  decide("P", 1, RevisionStep::Release);
  push("P", "M3\n");
  const auto admitted = admit("P", {}, Role::Administrator);
  ASSERT_TRUE(admitted) << admitted.error().what;
  EXPECT_EQ(admitted->revision.number, 1u) << "a newer draft changes nothing";
  EXPECT_EQ(admitted->allowed_as, RunAllowance::Released);
  EXPECT_EQ(admitted->approval, releases_->decisions("P", 1)->back().id);
  EXPECT_EQ(admit("P", 2, Role::Administrator).error().code, Errc::Conflict);
  decide("P", 1, RevisionStep::Withdraw);
  EXPECT_FALSE(admit("P"));
}

TEST_F(ReleasesTest, AMachineForProvingOutRunsDraftsOfThoseWhoMay) {
  use_policy("runs = \"release\"\n[prove_out]\nmachines = [\"mill-3\"]\nrole = \"programmer\"");
  release("P", "M2\n");
  push("P", "M3\n");
  const auto draft = admit("P", {}, Role::Programmer, "mill-3");
  ASSERT_TRUE(draft) << draft.error().what;
  EXPECT_EQ(draft->revision.number, 2u);
  EXPECT_EQ(draft->allowed_as, RunAllowance::ProveOut);
  EXPECT_FALSE(draft->approval);
  const auto released = admit("P", 1, Role::Programmer, "mill-3");
  EXPECT_EQ(released->allowed_as, RunAllowance::Released);
  EXPECT_EQ(admit("P", {}, Role::Operator, "mill-3")->revision.number, 1u);
  EXPECT_EQ(admit("P", 2, Role::Operator, "mill-3").error().what,
            "program P revision 2 is draft: machine 'mill-3' runs what is not released only when a "
            "programmer starts it");
  EXPECT_FALSE(admit("P", 2, Role::Administrator, "lathe-1"));
  decide("P", 2, RevisionStep::Withdraw);
  EXPECT_FALSE(admit("P", 2, Role::Administrator, "mill-3"));
}

TEST_F(ReleasesTest, StepsFollowThePolicy) {
  push("P", "M2\n");
  const auto refused = [&](RevisionStep step, Role role = Role::Approver) {
    const auto decided = try_decide("P", 1, step, {.role = role});
    return decided ? Errc{} : decided.error().code;
  };
  EXPECT_EQ(refused(RevisionStep::Release), Errc::Conflict) << "a draft";
  EXPECT_EQ(refused(RevisionStep::Approve), Errc::Conflict);
  EXPECT_EQ(refused(RevisionStep::Submit, Role::Operator), Errc::Denied);
  decide("P", 1, RevisionStep::Submit);
  EXPECT_EQ(refused(RevisionStep::Submit), Errc::Conflict) << "already";
  EXPECT_EQ(refused(RevisionStep::Approve, Role::Programmer), Errc::Denied);
  decide("P", 1, RevisionStep::Approve);
  decide("P", 1, RevisionStep::Reject);
  EXPECT_EQ(programs_->revision("P", 1)->state, RevisionState::Draft);
  EXPECT_EQ(try_decide("P", 9, RevisionStep::Submit, {}).error().code, Errc::NotFound);
}

TEST_F(ReleasesTest, FourEyesAreAnothersAlsoUnderAnotherName) {
  use_policy("[approve]\nfour_eyes = true");
  push("P", "M2\n");  // by cam
  decide("P", 1, RevisionStep::Submit);
  EXPECT_EQ(try_decide("P", 1, RevisionStep::Approve, {.who = "cam"}).error().code, Errc::Denied);
  ASSERT_TRUE(programs_->copy({.from = "P", .to = "Q", .who = "bert"}, std::nullopt));
  decide("Q", 1, RevisionStep::Submit);
  for (const char* author : {"cam", "bert"}) {
    EXPECT_EQ(try_decide("Q", 1, RevisionStep::Approve, {.who = author}).error().code, Errc::Denied)
        << author;
  }
  EXPECT_TRUE(try_decide("Q", 1, RevisionStep::Approve, {.who = "anna"}));
}

TEST_F(ReleasesTest, ACommentIsAskedForWhereThePolicySays) {
  use_policy("[withdraw]\ncomment = true");
  push("P", "M2\n");
  const auto withdraw = [&](const std::string& comment) {
    return try_decide("P", 1, RevisionStep::Withdraw, {.comment = comment});
  };
  EXPECT_EQ(withdraw("").error().code, Errc::Syntax);
  EXPECT_EQ(withdraw(" \n").error().code, Errc::Syntax);
  EXPECT_EQ(withdraw(std::string(1025, 'x')).error().code, Errc::LimitExceeded);
  EXPECT_TRUE(withdraw("cuts into the chuck"));
}

TEST_F(ReleasesTest, WhatCameFromAMachineIsAcceptedFirst) {
  auto upload = programs_->begin(
      {.program = "P", .control = "centurion", .comment = {}, .is_held = true}, "lathe");
  ASSERT_TRUE(programs_->append(upload->id, 0, bytes_of("M2\n")));
  ASSERT_TRUE(programs_->commit(upload->id, std::nullopt, "lathe"));
  EXPECT_EQ(try_decide("P", 1, RevisionStep::Submit, {}).error().code, Errc::Conflict);
  ASSERT_TRUE(programs_->accept("P", 1, "anna"));
  use_policy("runs = \"release\"");
  EXPECT_FALSE(admit("P")) << "accepted is not released";
  EXPECT_TRUE(try_decide("P", 1, RevisionStep::Submit, {}));
}

// -- signatures -----------------------------------------------------------------------------------

struct Tampering {
  const char *name, *sql;
};
class TamperedRelease : public ReleasesTest, public testing::WithParamInterface<Tampering> {};

/// With an editor for databases and without the key.
TEST_P(TamperedRelease, DoesNotRun) {
  use_policy("runs = \"release\"");
  release("P", "M2\n");
  push("P", "M3\n");
  release("P", "M4\n");
  decide("P", 3, RevisionStep::Withdraw);
  ASSERT_TRUE(admit("P"));
  change(GetParam().sql);
  const auto admitted = admit("P");
  ASSERT_FALSE(admitted);
  EXPECT_EQ(admitted.error().code, Errc::Corrupt) << admitted.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , TamperedRelease,
    testing::Values(
        Tampering{"draft_made_released",
                  "UPDATE revision SET state = 'released', released_us = 1 WHERE number = 2"},
        Tampering{"steps_of_another_revision_copied",
                  "UPDATE revision SET state = 'released', released_us = 1 WHERE number = 2;"
                  "INSERT INTO revision_step (program, revision, name, sha256, step, time_us, who, "
                  "credential, address, comment, policy, signature) SELECT program, 2, name, "
                  "sha256, step, time_us, who, credential, address, comment, policy, signature "
                  "FROM revision_step"},
        Tampering{"who", "UPDATE revision_step SET who = 'boss' WHERE step = 'approve'"},
        Tampering{"comment", "UPDATE revision_step SET comment = 'ok' WHERE step = 'release'"},
        Tampering{"address", "UPDATE revision_step SET address = '::1' WHERE step = 'release'"},
        Tampering{"time", "UPDATE revision_step SET time_us = time_us + 1 WHERE step = 'submit'"},
        Tampering{"step", "UPDATE revision_step SET step = 'approve' WHERE step = 'submit'"},
        Tampering{"policy", "UPDATE revision_step SET policy = zeroblob(32)"},
        Tampering{"signature", "UPDATE revision_step SET signature = zeroblob(64)"},
        Tampering{"withdrawal_undone",
                  "UPDATE revision SET state = 'released', withdrawn_us = NULL WHERE number = 3"},
        Tampering{"release_removed", "DELETE FROM revision_step WHERE step = 'release'"},
        Tampering{"other_bytes",
                  "UPDATE revision SET sha256 = (SELECT sha256 FROM revision WHERE "
                  "number = 2), content = (SELECT content FROM revision WHERE "
                  "number = 2) WHERE number = 1"}),
    [](const auto& i) { return std::string(i.param.name); });

TEST_F(ReleasesTest, AnotherNameIsNotWhatWasReleased) {
  use_policy("runs = \"release\"");
  release("P", "M2\n");
  ASSERT_TRUE(programs_->rename({.from = "P", .to = "Q", .who = "cam"}));
  EXPECT_EQ(admit("Q").error().code, Errc::Conflict);
  ASSERT_TRUE(programs_->rename({.from = "Q", .to = "P", .who = "cam"}));
  EXPECT_TRUE(admit("P"));
}

TEST_F(ReleasesTest, AnotherServersKeyReleasesNothingHere) {
  use_policy("runs = \"release\"");
  release("P", "M2\n");
  const auto text = releases_->text_of(releases_->decisions("P", 1)->front());
  EXPECT_NE(text.find("step submit\n"), std::string::npos);
  Releases other({.store = *store_,
                  .clock = clock_,
                  .key = SigningKey::of(std::string(64, '8')).value(),
                  .database = store_->identity().value()},
                 releases_->policy());
  EXPECT_EQ(other.admit({.machine = "lathe-1", .program = "P"}).error().code, Errc::Corrupt);
}

// -- called programs ------------------------------------------------------------------------------

TEST_F(ReleasesTest, ARunCallsOnlyWhatWasReleasedWhenItBegan) {
  use_policy("runs = \"release\"");
  const auto main = release("P", "M2\n");
  const auto draft = push("SUB", "M99\n");
  add_machine("lathe-1");
  const auto begin = [&](const std::string& id) {
    Run run = run_of(main, id);
    run.allowed_as = RunAllowance::Released;
    EXPECT_TRUE(store_->runs.create(run));
    return store_->runs.find(id).value();
  };
  const auto end = [&](const Run& run) {
    EXPECT_TRUE(store_->runs.set_state(run.id, storage::RunState::Interrupted, ""));
  };
  const Run first = begin("r1");
  EXPECT_FALSE(Releases::may_call(draft, first));
  take_to_release("SUB", 1);
  const auto released = programs_->revision("SUB", 1).value();
  EXPECT_FALSE(Releases::may_call(released, first)) << "released after the run began";
  end(first);
  const Run second = begin("r2");
  EXPECT_TRUE(Releases::may_call(released, second));
  EXPECT_TRUE(releases_->check_call(released, second));
  decide("SUB", 1, RevisionStep::Withdraw);
  const auto withdrawn = programs_->revision("SUB", 1).value();
  EXPECT_TRUE(Releases::may_call(withdrawn, second)) << "the run keeps what it began with";
  EXPECT_TRUE(releases_->check_call(withdrawn, second));
  end(second);
  EXPECT_FALSE(Releases::may_call(withdrawn, begin("r3")));
  change("UPDATE revision_step SET time_us = 1 WHERE name = 'SUB' AND step = 'release'");
  EXPECT_EQ(releases_->check_call(withdrawn, second).error().code, Errc::Corrupt);
}

}  // namespace
}  // namespace dripline::server_test
