// A revision from its author to a machine with the real programs: two people, one policy, one
// lathe.
#include <gtest/gtest.h>
#include <fstream>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using test_support::Finished;

class Release : public testing::Test {
 protected:
  Release() {
    const auto policy = system.folder() / "policy.toml";
    std::ofstream(policy) << "runs = \"release\"\n[approve]\nfour_eyes = true\n";
    system.add_server_argument("--policy");
    system.add_server_argument(policy.string());
    system.start_server();
    for (const std::string name : {"anna", "bert"}) {
      good(admin("user add " + name + " --role approver --group all"));
      const auto made = admin("token add t --user " + name + " 2>/dev/null");
      std::ofstream(system.folder() / name) << made.output;
    }
  }
  Finished run_shell(const std::string& command) {
    return test_support::run_to_end({"/bin/sh", "-c", command}, system.folder() / "dnc.out");
  }
  Finished admin(const std::string& arguments) {
    return run_shell(program_path("dnc") + " --state " + system.server_state().string() + " " +
                     arguments);
  }
  Finished as(const std::string& name, const std::string& arguments) {
    return run_shell(program_path("dnc") + " --server " + system.url() + " --token-file " +
                     (system.folder() / name).string() + " " + arguments);
  }
  static void good(const Finished& done) { EXPECT_EQ(done.status, 0) << done.output; }
  static void refused(const Finished& done, const std::string& part) {
    EXPECT_NE(done.status, 0) << done.output;
    EXPECT_NE(done.output.find(part), std::string::npos) << done.output;
  }

  System system;
};

TEST_F(Release, TakesTwoPeopleAndOutlivesARestartOfTheServer) {
  system.start_gateway();
  system.wait_connected();
  const auto file = system.folder() / "O1";
  std::ofstream(file) << "G00 X1.\nM30\n";
  good(as("anna", "program push " + file.string() + " --name O1 --control centurion"));
  refused(as("anna", "run start lathe-1 O1"), "is draft");
  good(as("anna", "program submit O1 1"));
  refused(as("anna", "program approve O1 1"), "asks for another");
  good(as("bert", "program approve O1 1"));
  refused(as("bert", "run start lathe-1 O1"), "is approved");
  good(as("bert", "program release O1 1 --comment first"));
  system.server().signal(15);
  EXPECT_EQ(system.server().wait(), 0);
  system.start_server();
  system.wait_connected();
  const auto started = as("anna", "run start lathe-1 O1 --json");
  ASSERT_EQ(started.status, 0) << started.output;
  const auto run = system.wait_ended(nlohmann::json::parse(started.output)["id"]);
  EXPECT_EQ(run["state"], "completed");
  EXPECT_EQ(run["allowed_as"], "released");
  EXPECT_EQ(run["approval"], 3);
  const std::string id = run["id"], paper = (system.folder() / "paper").string();
  good(as("anna", "run attestation " + id + " -o " + paper));
  const auto verified = as("anna", "run verify " + paper + " --program " + file.string());
  EXPECT_EQ(verified.status, 0) << verified.output;
  EXPECT_NE(verified.output.find("bert"), std::string::npos) << "who released it";
  good(as("bert", "program withdraw O1 1"));
  good(as("anna", "run verify " + paper));
  refused(as("anna", "run verify " + paper + " --program " + paper), "is not the program");
  good(run_shell("sed -i s/completed/alarmed/ " + paper));
  refused(as("anna", "run verify " + paper), "it was changed");
  refused(as("anna", "run start lathe-1 O1"), "is withdrawn");
}

TEST_F(Release, PinsWhatAProgramCallsSoThatANewerSubprogramDoesNotRun) {
  system.start_gateway();
  system.wait_connected();
  const auto push = [&](const std::string& name, const std::string& text) {
    const auto file = system.folder() / "text.nc";
    std::ofstream(file) << text;
    good(as("anna", "program push " + file.string() + " --name " + name + " --control centurion"));
  };
  const auto approve = [&](const std::string& revision) {
    good(as("anna", "program submit " + revision));
    good(as("bert", "program approve " + revision));
  };
  push("O1", "O1\nM98 P2\nDPRNT[END]\nM30\n");
  refused(as("anna", "program closure O1"), "missing: O0002");
  push("O0002", "O2\nPOPEN P1\nDPRNT[APPROVED]\nM99\n");
  good(as("anna", "program closure O1"));
  approve("O1 1");
  refused(as("bert", "program release O1 1 --closure"), "O0002 revision 1 is draft");
  approve("O0002 1");
  good(as("bert", "program release O1 1 --closure"));
  push("O0002", "O2\nPOPEN P1\nDPRNT[NEWER]\nM99\n");
  approve("O0002 2");
  good(as("bert", "program release O0002 2"));
  const auto started = as("anna", "run start lathe-1 O1 --json");
  ASSERT_EQ(started.status, 0) << started.output;
  const std::string id = nlohmann::json::parse(started.output)["id"];
  EXPECT_EQ(system.wait_ended(id)["state"], "completed");
  const auto report = as("anna", "report show " + id);
  EXPECT_NE(report.output.find("APPROVED"), std::string::npos) << report.output;
  EXPECT_EQ(report.output.find("NEWER"), std::string::npos) << report.output;
  const auto states = as("anna", "program states O1 1");
  EXPECT_NE(states.output.find("O0002"), std::string::npos) << states.output;
  const std::string paper = (system.folder() / "paper").string();
  good(as("anna", "run attestation " + id + " -o " + paper));
  good(as("anna", "run verify " + paper));
  good(run_shell("grep -q 'calls O0002 1 ' " + paper));
  good(run_shell("grep -q '^called_1 .* = O0002 revision 1 sha256 ' " + paper));
}

TEST_F(Release, APolicyThatIsNotUnderstoodKeepsTheServerFromStarting) {
  system.server().signal(15);
  EXPECT_EQ(system.server().wait(), 0);
  std::ofstream(system.folder() / "policy.toml") << "runs = \"realease\"\n";
  system.launch_server();
  EXPECT_EQ(system.server().wait(), 2);
}

}  // namespace
}  // namespace dripline::integration
