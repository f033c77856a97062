// `dnc` as its users type it: what it prints, what it exits with, what it leaves after.
#include <gtest/gtest.h>
#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>

#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using test_support::Finished;

class Cli : public testing::Test {
 protected:
  Finished dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system.server_state()});
    return test_support::run_to_end(arguments, system.folder() / "dnc.out");
  }
  nlohmann::json dnc_json(std::vector<std::string> arguments) {
    arguments.push_back("--json");
    const auto done = dnc(std::move(arguments));
    EXPECT_EQ(done.status, 0) << done.output;
    const auto json = nlohmann::json::parse(done.output, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << done.output;
    return json;
  }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(system.folder() / name, std::ios::binary) << text;
    return system.folder() / name;
  }
  std::string read(const std::string& name) {
    std::ifstream file(system.folder() / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void start_all() {
    system.start_server();
    system.start_gateway();
    system.wait_connected();
  }
  System system;
};

std::string report_program(std::uint64_t lines) {
  std::string text;
  test_support::write_report_program(lines, 2, [&](std::string_view piece) { text += piece; });
  return text;
}

TEST_F(Cli, TheNewestSetupOfAMachineGoesWithTheStart) {
  start_all();
  const auto setup_of = [&](int value) {
    return write("setup.toml",
                 "[[variable]]\nname = \"P10\"\nvalue = " + std::to_string(value) + "\n");
  };
  EXPECT_EQ(dnc_json({"setup", "push", "lathe-1", setup_of(7)}).at("revision"), 1);
  const auto second = dnc({"setup", "push", "lathe-1", setup_of(8), "-m", "new"});
  EXPECT_EQ(second.status, 0) << second.output;
  const auto refused = dnc({"setup", "push", "lathe-1", write("bad.toml", "color = 1\n")});
  EXPECT_NE(refused.status, 0) << refused.output;
  EXPECT_NE(refused.output.find("color"), std::string::npos) << refused.output;
  const std::string text = "POPEN P0\nDPRNT [#10[10]]\nPCLOS\nM30\n";
  dnc({"program", "push", write("p.nc", text), "--name", "O1", "--control", "centurion"});
  EXPECT_EQ(dnc({"run", "start", "lathe-1", "O1", "--follow"}).status, 0);
  EXPECT_EQ(dnc({"report", "export", "latest"}).output, "8\n");
  EXPECT_EQ(dnc({"setup", "restore", "lathe-1", "1"}).status, 0);
  EXPECT_EQ(dnc({"run", "start", "lathe-1", "O1", "--follow"}).status, 0);
  EXPECT_EQ(dnc({"report", "export", "latest"}).output, "7\n");
  EXPECT_EQ(dnc_json({"run", "show", "latest"}).at("setup"), 3);
  EXPECT_EQ(dnc({"setup", "pull", "lathe-1", "-r", "1"}).output,
            read("setup.toml").replace(34, 1, "7"));
  EXPECT_EQ(dnc_json({"setup", "list", "lathe-1"}).at("setups").size(), 3u);
}

/// What a lathe's control keeps: parameters, tool table, work coordinates, power-on values.
std::string lathe_memory(char digit) {
  std::string text = R"(units = "in"
[control]
power_on_feed = 0.#
tool_changer = true
[[variable]]
name = "P0"
value = #
[[variable]]
name = "P99"
value = -#
[[offset]]
name = "G54"
Z = -1#.0
[[tool]]
number = 3
X = 0.#
Z = #.25
radius = 0.03
tip = 3
)";
  std::replace(text.begin(), text.end(), '#', digit);
  return text;
}

/// CEN-220: a backup of all of it is one file.
TEST_F(Cli, TheWholeMemoryOfALatheComesBackFromItsBackup) {
  start_all();
  const std::string text =
      "POPEN P0\nG54\nT0303 M6\nDPRNT "
      "[#0[21]#99[21]#232[31]#240[23]#241[23]#366[13]]\nPCLOS\nM30\n";
  dnc({"program", "push", write("p.nc", text), "--name", "O1", "--control", "centurion"});
  const auto state = [&] {
    EXPECT_EQ(dnc({"run", "start", "lathe-1", "O1", "--follow"}).status, 0);
    return dnc({"report", "export", "latest"}).output;
  };
  EXPECT_EQ(dnc({"setup", "push", "lathe-1", write("a.toml", lathe_memory('5'))}).status, 0);
  const std::string before = state();
  const auto backup = (system.folder() / "backup.toml").string();
  EXPECT_EQ(dnc({"setup", "pull", "lathe-1", "-o", backup}).status, 0);
  EXPECT_EQ(read("backup.toml"), lathe_memory('5'));

  EXPECT_EQ(dnc({"setup", "push", "lathe-1", write("b.toml", lathe_memory('8'))}).status, 0);
  const std::string changed = state();
  EXPECT_EQ(dnc({"setup", "push", "lathe-1", backup, "-m", "from the backup"}).status, 0);
  EXPECT_EQ(state(), before);
  // P0, P99, the active work coordinate, the tool's lengths in Z and X, the power-on feed.
  EXPECT_EQ(before, "05.0-05.0-015.005.25000.5000.500\n");
  EXPECT_EQ(changed, "08.0-08.0-018.008.25000.8000.800\n");
  EXPECT_EQ(dnc_json({"setup", "list", "lathe-1"}).at("setups").size(), 3u);
}

/// What the control of one machine keeps, after its gateway went and the server was started again,
/// goes to another machine.
TEST_F(Cli, TheMemoryOfAMachineThatIsAwayGoesToAnother) {
  start_all();
  const std::string change = "P10=7.5\nG10\nP500=1.25\nG11\nM30\n";
  const std::string print = "POPEN P0\nP11=P500\nDPRNT [#10[22] #11[22]]\nPCLOS\nM30\n";
  dnc({"program", "push", write("c.nc", change), "--name", "O1", "--control", "centurion"});
  dnc({"program", "push", write("p.nc", print), "--name", "O2", "--control", "centurion"});
  EXPECT_EQ(dnc({"run", "start", "lathe-1", "O1", "--wait"}).status, 0);
  const std::string run = dnc_json({"run", "show", "latest"}).at("id");
  const auto cells = [&] { return dnc_json({"memory", "show", "lathe-1"}).at("cells"); };
  const auto before = cells();
  EXPECT_EQ(before.size(), 2u) << before;

  system.gateway().signal(SIGTERM);
  system.gateway().wait();
  system.server().signal(SIGTERM);
  ASSERT_EQ(system.server().wait(), 0);
  system.start_server();
  EXPECT_EQ(cells(), before);
  const auto shown = dnc({"memory", "show", "lathe-1"});
  EXPECT_NE(shown.output.find("not connected, last seen"), std::string::npos) << shown.output;

  system.start_gateway("lathe-2");
  system.wait_connected("lathe-2");
  const auto none = dnc({"memory", "show", "lathe-2"});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.output.find("no run of lathe-2"), std::string::npos) << none.output;
  EXPECT_EQ(dnc({"setup", "push", "lathe-2", write("s.toml", "# lathe 2\n")}).status, 0);
  const auto restored = dnc({"memory", "restore", "lathe-2", run});
  EXPECT_EQ(restored.status, 0) << restored.output;
  EXPECT_EQ(dnc({"run", "start", "lathe-2", "O2", "--wait"}).status, 0);
  const auto line = dnc({"report", "export", "latest"}).output;
  EXPECT_NE(line.find("7.50"), std::string::npos) << line;
  EXPECT_NE(line.find("1.25"), std::string::npos) << line;
}

/// At the machine and from the network the reason is the same.
TEST_F(Cli, AStartInTheMiddleNamesWhatItWouldCountTwice) {
  start_all();
  const std::string count = "G98 F900\nP10=P10+1\nG0 X1 Z1\nN30 G1 X2\nM30\n";
  dnc({"program", "push", write("c.nc", count), "--name", "O1", "--control", "centurion"});
  EXPECT_EQ(dnc({"run", "start", "lathe-1", "O1", "--wait"}).status, 0);
  const auto refused = dnc({"run", "start", "lathe-1", "O1", "--from", "N30", "--wait"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("P10"), std::string::npos) << refused.output;
  EXPECT_EQ(dnc({"run", "start", "lathe-1", "O1", "--memory", "now"}).status, 1)
      << "without --from";
  const std::string reason = dnc_json({"run", "show", "latest"}).at("reason");
  EXPECT_NE(reason.find("CEN1013"), std::string::npos) << reason;
}

TEST_F(Cli, AProgramGoesInRunsAndItsReportComesOut) {
  start_all();
  const std::string text = report_program(25);
  const auto pushed =
      dnc({"program", "push", write("part.nc", text), "--name", "O0300", "--control", "centurion"});
  EXPECT_EQ(pushed.status, 0) << pushed.output;
  const auto ran = dnc({"run", "start", "lathe-1", "O0300", "--follow"});
  EXPECT_EQ(ran.status, 0) << ran.output;
  EXPECT_NE(ran.output.find("completed"), std::string::npos) << ran.output;

  const auto report = dnc({"report", "show", "latest"});
  EXPECT_NE(report.output.find("LINE 00025"), std::string::npos) << report.output;
  EXPECT_EQ(
      dnc({"report", "export", "latest", "--format", "csv", "-o", system.folder() / "report.csv"})
          .status,
      0);
  EXPECT_NE(read("report.csv").find("LINE 00001"), std::string::npos);
  EXPECT_EQ(dnc({"program", "pull", "O0300", "-o", system.folder() / "back.nc"}).status, 0);
  EXPECT_EQ(read("back.nc"), text);
}

TEST_F(Cli, EveryListingSpeaksJson) {
  start_all();
  dnc({"program", "push", write("part.nc", report_program(2)), "--name", "O0300", "--control",
       "centurion"});
  dnc({"run", "start", "lathe-1", "O0300", "--follow"});
  EXPECT_EQ(dnc_json({"program", "list"})["programs"].size(), 1u);
  EXPECT_EQ(dnc_json({"program", "show", "O0300"}).value("name", ""), "O0300");
  EXPECT_EQ(dnc_json({"machine", "list"})["machines"].size(), 1u);
  EXPECT_EQ(dnc_json({"machine", "status", "lathe-1"}).value("name", ""), "lathe-1");
  EXPECT_EQ(dnc_json({"run", "list"})["runs"].size(), 1u);
  EXPECT_EQ(dnc_json({"run", "show", "latest"}).value("state", ""), "completed");
  EXPECT_EQ(dnc_json({"report", "list"})["reports"].size(), 1u);
  EXPECT_TRUE(dnc_json({"server", "status"}).contains("version"));
}

TEST_F(Cli, ARunThatAlarmsEndsWithStatusOne) {
  start_all();
  dnc({"program", "push", write("bad.nc", "O0400\nG20\nG0 X1 Z1\nP1=1/0\nM30\n"), "--name", "O0400",
       "--control", "centurion"});
  const auto ran = dnc({"run", "start", "lathe-1", "O0400", "--follow"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.output.find("CEN"), std::string::npos) << ran.output;
}

TEST_F(Cli, ErrorsNameTheThing) {
  start_all();
  const auto missing = dnc({"program", "show", "O7777"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.output.find("O7777"), std::string::npos) << missing.output;
  const auto unreadable = dnc({"program", "push", "/no/such/file.nc"});
  EXPECT_EQ(unreadable.status, 2);
  EXPECT_NE(unreadable.output.find("/no/such/file.nc"), std::string::npos) << unreadable.output;
  const auto no_machine = dnc({"run", "start", "lathe-9", "O7777"});
  EXPECT_EQ(no_machine.status, 1);
  EXPECT_NE(no_machine.output.find("lathe-9"), std::string::npos) << no_machine.output;
}

TEST_F(Cli, WithoutAServerItSaysWhereItLooked) {
  const auto done = test_support::run_to_end(
      {program_path("dnc"), "--server", "http://127.0.0.1:1", "program", "list"},
      system.folder() / "dnc.out");
  EXPECT_EQ(done.status, 3) << done.output;
  EXPECT_NE(done.output.find("127.0.0.1:1"), std::string::npos) << done.output;
}

TEST_F(Cli, ProgressIsSilentInAPipe) {
  start_all();
  const auto pushed = dnc({"program", "push", write("part.nc", report_program(2)), "--name",
                           "O0300", "--control", "centurion"});
  EXPECT_EQ(pushed.output.find('\r'), std::string::npos) << pushed.output;
  EXPECT_EQ(pushed.output.find('\x1b'), std::string::npos) << pushed.output;
}

TEST_F(Cli, TheServerRefusesToListenBeyondLoopbackWithoutTls) {
  const auto done =
      test_support::run_to_end({program_path("dncd"), "--state", system.server_state(), "--http",
                                "0.0.0.0:0", "--dds-domain", "90"},
                               system.folder() / "dncd.out");
  EXPECT_EQ(done.status, 2) << done.output;
  EXPECT_NE(done.output.find("TLS"), std::string::npos) << done.output;
}

}  // namespace
}  // namespace dripline::integration
