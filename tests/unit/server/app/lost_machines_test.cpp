#include "server/app/impl/lost_machines.hpp"

#include <gtest/gtest.h>

#include "tests/support/manual_clock.hpp"

namespace dripline::app {
namespace {

using std::chrono::seconds;

class LostMachinesTest : public testing::Test {
 protected:
  static machines::MachineView view(const std::string& name, bool is_connected,
                                    const std::string& gateway_version = "0.1.0") {
    machines::MachineView made;
    made.machine.name = name;
    made.machine.gateway_version = gateway_version;
    made.is_connected = is_connected;
    return made;
  }
  static storage::Run run(const std::string& machine) {
    storage::Run made;
    made.id = "r-" + machine;
    made.machine = machine;
    made.program = "O0300";
    return made;
  }
  void look(const std::vector<machines::MachineView>& machines) {
    lost_.look(machines, {run("lathe-1"), run("line-1")});
  }
  std::string findings() const {
    std::string all;
    for (const auto& finding : health_.state().findings)
      all += finding.subject + ": " + finding.detail + "\n";
    return all;
  }

  test_support::ManualClock clock_;
  library::Health health_{clock_};
  LostMachines lost_{health_, clock_};
};

TEST_F(LostMachinesTest, AMachineThatIsAwayInItsRunIsNamed) {
  look({view("lathe-1", false), view("lathe-2", false)});
  EXPECT_EQ(findings(), "") << "it may only change to another server";
  clock_.advance(seconds(6));
  look({view("lathe-1", false), view("lathe-2", false)});
  EXPECT_EQ(health_.state().level, library::Health::Level::Degraded);
  EXPECT_EQ(findings().find("connection: machine=lathe-1: not connected for 6 s in run r-lathe-1 "
                            "of O0300."),
            0U)
      << findings();
  EXPECT_EQ(findings().find("lathe-2"), std::string::npos) << "has no run: " << findings();
}

TEST_F(LostMachinesTest, OneThatIsThereAgainIsNoFinding) {
  look({view("lathe-1", false)});
  clock_.advance(seconds(6));
  look({view("lathe-1", false)});
  EXPECT_NE(findings(), "");
  look({view("lathe-1", true)});
  EXPECT_EQ(findings(), "");
  look({view("lathe-1", false)});
  EXPECT_EQ(findings(), "") << "the grace begins again";
}

TEST_F(LostMachinesTest, NorIsOneWhoseRunHasEnded) {
  look({view("lathe-1", false)});
  clock_.advance(seconds(6));
  look({view("lathe-1", false)});
  EXPECT_NE(findings(), "");
  lost_.look({view("lathe-1", false)}, {});
  EXPECT_EQ(findings(), "");
}

/// Its port has findings of its own.
TEST_F(LostMachinesTest, AMachineOnALineOfTheServerHasNoGateway) {
  const std::vector machines{view("line-1", false, "")};
  EXPECT_FALSE(LostMachines::is_any_away(machines));
  look(machines);
  clock_.advance(seconds(6));
  look(machines);
  EXPECT_EQ(findings(), "");
}

}  // namespace
}  // namespace dripline::app
