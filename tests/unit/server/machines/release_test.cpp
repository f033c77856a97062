// What a machine at a gateway gets under the policy `release`.
#include "server/machines/control_memory.hpp"
#include "tests/unit/server/library/release_fixture.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::Role;
using storage::RunAllowance;

class MachineRelease : public ReleaseSteps<MachineServiceTest> {
 protected:
  void begin(const std::string& policy = "runs = \"release\"") {
    use_policy(policy);
    start_service();
    announce();
    answer_commands(true);
  }
  struct Wanted {
    std::string program;
    Role role = Role::Viewer;
    std::optional<std::uint64_t> revision = {};
    std::optional<machines::RestartRequest> restart = {};
  };
  Result<Run> try_start(const Wanted& wanted) {
    const machines::StartRequest request{.machine = "lathe-1",
                                         .program = wanted.program,
                                         .revision = wanted.revision,
                                         .author = "anna",
                                         .role = wanted.role,
                                         .restart = wanted.restart};
    return service_->start(request);
  }
  std::size_t starts() {
    const std::lock_guard lock(written_->mutex);
    return static_cast<std::size_t>(
        std::ranges::count(written_->commands, dds::CommandAction::Start, &dds::Command::action));
  }
  void end(const std::string& run) {
    ASSERT_TRUE(store_->runs.set_state(run, storage::RunState::Interrupted, "cut off"));
  }
};

TEST_F(MachineRelease, NothingLeavesForTheGatewayThatIsNotReleased) {
  begin();
  push("O0100", "M30\n");
  const auto refused = try_start({.program = "O0100", .role = Role::Administrator});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "program O0100 revision 1 is draft: machine 'lathe-1' runs released revisions only");
  EXPECT_FALSE(try_start({.program = "O0100", .revision = 1}));
  EXPECT_EQ(starts(), 0u);
  EXPECT_TRUE(store_->runs.list({}, {})->empty()) << "and there is no run of it";
  take_to_release("O0100", 1);
  const auto run = try_start({.program = "O0100"});
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->allowed_as, RunAllowance::Released);
  EXPECT_EQ(run->approval, releases_->decisions("O0100", 1)->back().id);
  EXPECT_EQ(starts(), 1u);
}

TEST_F(MachineRelease, ARunOfAJobNamesItAndAHeldQueueStartsNothing) {
  add_machine("lathe-1");  // its announcement would be stored a little later
  begin();
  release("O0100", "M30\n");
  storage::Job job;
  job.machine = "lathe-1";
  job.program = "O0100";
  const auto added = store_->jobs.add(job, "anna", {});
  ASSERT_TRUE(added) << added.error().what;
  const machines::StartRequest request{
      .machine = "lathe-1", .program = "O0100", .revision = {}, .author = "anna", .job = added->id};
  ASSERT_TRUE(store_->jobs.hold({"lathe-1", "anna", "wide", clock_.now()}, "anna"));
  EXPECT_EQ(service_->start(request).error().code, Errc::Conflict);
  EXPECT_EQ(starts(), 0u) << "checked where the run is stored, no matter who asks";
  ASSERT_TRUE(store_->jobs.release("lathe-1", "anna", clock_.now()));
  const auto run = service_->start(request);
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->job, added->id);
  EXPECT_EQ(starts(), 1u);
}

TEST_F(MachineRelease, ACalledProgramIsReleasedTooOrIsNotFound) {
  begin();
  release("O0100", "M98 P0200\nM30\n");
  const auto sub = release("O0200", "G04\nM99\n");
  push("O0200", "G01 X99\nM99\n");  // a newer draft
  push("O0300", "M99\n");
  clock_.advance(std::chrono::seconds(1));
  const auto run = try_start({.program = "O0100"});
  ASSERT_TRUE(run) << run.error().what;
  request(run->id, 0, 100, "O0200");
  EXPECT_EQ(fed(1), "G04\nM99\n");
  EXPECT_EQ(first_block().content, sub.content.hex());
  const auto missing =
      machines::resolve_called_program({*store_, *releases_, clock_}, *run, "O0300");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().what,
            "program 'O0300' called by 'O0100' was not released for control centurion when the run "
            "began");
}

TEST_F(MachineRelease, ANewerSubprogramThanTheReleasePinsDoesNotRun) {
  begin();
  push("O0100", "M98 P0200\nM30\n");
  push("O0200", "G04\nM99\n");
  for (const std::string program : {"O0100", "O0200"}) {
    decide(program, 1, storage::RevisionStep::Submit);
    decide(program, 1, storage::RevisionStep::Approve);
  }
  const auto main = programs_->revision("O0100", 1).value();
  auto closure = releases_->closure({.main = main, .machine = {}, .named = {}});
  ASSERT_TRUE(closure) << closure.error().what;
  const auto released = releases_->decide({.program = "O0100",
                                           .revision = 1,
                                           .step = storage::RevisionStep::Release,
                                           .comment = {},
                                           .who = {"anna", "token", ""},
                                           .role = Role::Approver,
                                           .closure = *std::move(closure)});
  ASSERT_TRUE(released) << released.error().what;
  const auto pinned = programs_->revision("O0200", 1).value();
  EXPECT_EQ(pinned.state, storage::RevisionState::Released) << "with its caller";
  release("O0200", "G01 X99\nM99\n");
  release("O0300", "M99\n");
  clock_.advance(std::chrono::seconds(1));
  const auto run = try_start({.program = "O0100"});
  ASSERT_TRUE(run) << run.error().what;
  request(run->id, 0, 100, "O0200");
  EXPECT_EQ(fed(1), "G04\nM99\n") << "revision 2 is released and newer";
  EXPECT_EQ(first_block().content, pinned.content.hex());
  const auto other = machines::resolve_called_program({*store_, *releases_, clock_}, *run, "O0300");
  ASSERT_FALSE(other) << "what was not approved with it is not called";
  EXPECT_EQ(other.error().code, Errc::NotFound);
  end(run->id);
  decide("O0200", 1, storage::RevisionStep::Withdraw);
  EXPECT_EQ(try_start({.program = "O0100"}).error().what,
            "program O0100 revision 1 calls O0200 revision 1, which was withdrawn");
}

TEST_F(MachineRelease, ARestartIsJudgedAnew) {
  begin();
  release("O0100", "M30\n");
  const auto run = try_start({.program = "O0100"});
  ASSERT_TRUE(run) << run.error().what;
  end(run->id);
  push("O0100", "M31\n");  // a draft is no newer revision for this machine
  const Wanted again{
      .program = "O0100", .revision = 1, .restart = machines::RestartRequest{.run = run->id}};
  const auto restarted = try_start(again);
  ASSERT_TRUE(restarted) << restarted.error().what;
  EXPECT_EQ(restarted->allowed_as, RunAllowance::Released);
  end(restarted->id);
  decide("O0100", 1, storage::RevisionStep::Withdraw);
  EXPECT_EQ(try_start(again).error().what, "program O0100 revision 1 is withdrawn");
}

TEST_F(MachineRelease, AMachineForProvingOutTakesADraftOfOneWhoMay) {
  begin("runs = \"release\"\n[prove_out]\nmachines = [\"lathe-1\"]");
  push("O0100", "M98 P0200\nM30\n");
  push("O0200", "M99\n");
  EXPECT_FALSE(try_start({.program = "O0100", .role = Role::Operator}));
  clock_.advance(std::chrono::seconds(1));
  const auto run = try_start({.program = "O0100", .role = Role::Programmer});
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->allowed_as, RunAllowance::ProveOut);
  EXPECT_FALSE(run->approval);
  EXPECT_TRUE(machines::resolve_called_program({*store_, *releases_, clock_}, *run, "O0200"));
}

}  // namespace
}  // namespace dripline::server_test
