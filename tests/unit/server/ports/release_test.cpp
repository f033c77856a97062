// What a machine on a serial line gets under the policy `release`: runs, what its operator asks
// for, and programs for its memory.
#include "tests/support/line/played_control.hpp"
#include "tests/unit/server/library/release_fixture.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::Role;
using storage::RunAllowance;
using storage::RunState;
using test_support::PlayedControl;
using Kind = wire::TransferRequest::Kind;

class LineRelease : public ReleaseSteps<PortServiceTest> {
 protected:
  /// The mill's control is a TNC that asks for programs.
  void begin(const std::string& policy = "runs = \"release\"") {
    use_policy(policy);
    start_ports();
    add_machine("mill", "tnc155");
    auto port = mill();
    port.settings = {{"baud", "115200"}, {"flow", "heidenhain_bcc"}, {"offer", "all"}};
    add_port(port);
    control_ = std::make_unique<PlayedControl>(ports_->port("com1")->settings, line());
  }
  static std::string tnc_program(int number, int x) {
    return fmt::format("0 BEGIN PGM {0} MM\n1 L X+{1} Y+0 F200 M\n2 END PGM {0} MM\n", number, x);
  }
  void ask(Kind kind, const std::string& name) {
    ASSERT_TRUE(control_->line().request({kind, name}, control_->now()));
  }
  struct Wanted {
    std::string program;
    Role role = Role::Viewer;
    std::optional<std::uint64_t> revision = {};
    std::optional<machines::RestartRequest> restart = {};
  };
  Result<Run> try_start(const Wanted& wanted) {
    const machines::StartRequest request{.machine = "mill",
                                         .program = wanted.program,
                                         .revision = wanted.revision,
                                         .author = "anna",
                                         .role = wanted.role,
                                         .restart = wanted.restart};
    return ports_->machines().start(request);
  }
  std::vector<Run> runs() { return store_->runs.list({}, {}).value(); }

  std::unique_ptr<PlayedControl> control_;
};

TEST_F(LineRelease, ARunIsOfAReleasedRevision) {
  begin();
  push("15.h", tnc_program(15, 1), "tnc155");
  const auto refused = try_start({.program = "15.h", .role = Role::Administrator});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "program 15.h revision 1 is draft: machine 'mill' runs released revisions only");
  EXPECT_TRUE(runs().empty());
  take_to_release("15.h", 1);
  const auto run = try_start({.program = "15.h"});
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->allowed_as, RunAllowance::Released);
  EXPECT_EQ(run->approval, releases_->decisions("15.h", 1)->back().id);
}

TEST_F(LineRelease, WhatTheOperatorAsksForIsTheReleasedRevision) {
  begin();
  const std::string text = tnc_program(15, 1);
  push("15.h", text, "tnc155");
  ask(Kind::SendProgram, "15");
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  EXPECT_TRUE(runs().empty()) << "a draft is refused";
  take_to_release("15.h", 1);
  push("15.h", tnc_program(15, 2), "tnc155");  // a newer draft
  ask(Kind::SendProgram, "15");
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  EXPECT_EQ(control_->programs[0], text);
  ASSERT_TRUE(control_->until([&] { return runs().front().state == RunState::Completed; }));
  EXPECT_EQ(runs().front().revision, 1u);
  EXPECT_EQ(runs().front().allowed_as, RunAllowance::Released);
}

/// The operator has no role at a control, also at a machine for proving out.
TEST_F(LineRelease, AMachineForProvingOutGivesItsControlReleasedRevisionsOnly) {
  begin("runs = \"release\"\n[prove_out]\nmachines = [\"mill\"]");
  push("15.h", tnc_program(15, 1), "tnc155");
  ask(Kind::SendProgram, "15");
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  const auto run = try_start({.program = "15.h", .role = Role::Programmer});
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->allowed_as, RunAllowance::ProveOut);
}

TEST_F(LineRelease, OnlyReleasedProgramsAreOffered) {
  begin();
  push("7.h", tnc_program(7, 1), "tnc155");
  push("15.h", tnc_program(15, 1), "tnc155");
  take_to_release("15.h", 1);
  push("15.h", tnc_program(15, 2), "tnc155");
  ask(Kind::Directory, "");
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  EXPECT_EQ(control_->programs[0], tnc_program(15, 1));
  ask(Kind::Directory, "");
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  EXPECT_EQ(control_->programs.size(), 1u);
}

TEST_F(LineRelease, WhatWasWithdrawnSinceTheListIsNotSent) {
  begin();
  for (const int number : {7, 15}) {
    push(fmt::format("{}.h", number), tnc_program(number, 1), "tnc155");
    take_to_release(fmt::format("{}.h", number), 1);
  }
  ask(Kind::Directory, "");
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  decide("15.h", 1, storage::RevisionStep::Withdraw);
  ask(Kind::Directory, "");
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  EXPECT_EQ(control_->programs.size(), 1u);
}

TEST_F(LineRelease, AControlsMemoryGetsReleasedRevisionsOnly) {
  use_policy("runs = \"release\"\n[prove_out]\nmachines = [\"mill\"]");
  start_ports();
  add_machine("mill");
  add_port(mill());
  push("O1", "O1\nG0 X1\n");
  const auto refused = ports_->send("com1", {{.program = "O1", .revision = {}}});
  ASSERT_FALSE(refused) << "who will start it there is not known";
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  take_to_release("O1", 1);
  push("O1", "O1\nG0 X2\n");
  ASSERT_TRUE(ports_->send("com1", {{.program = "O1", .revision = {}}}));
  EXPECT_EQ(line().read_until("X1\n"), "O1\nG0 X1\n");
}

}  // namespace
}  // namespace dripline::server_test
