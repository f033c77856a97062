// Programs out of a control's memory and into it, without a run.
#include "tests/support/line/played_control.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using test_support::PlayedControl;

class LineTransferTest : public PortServiceTest {
 protected:
  void add_mill(const std::vector<std::pair<std::string, std::string>>& more) {
    start_ports();
    add_machine("mill");
    auto port = mill();
    for (const auto& setting : more) port.settings.push_back(setting);
    add_port(port);
  }
  std::string text_of(const std::string& program, std::uint64_t number = 1) {
    const auto revision = store_->programs.revision(program, number);
    if (!revision) return revision.error().what;
    const auto bytes = store_->programs.read_content(revision->content, 0, revision->size);
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
  }
  bool wait_stored(const std::string& program, std::uint64_t number = 1) {
    return wait([&] { return store_->programs.revision(program, number).has_value(); });
  }
  bool is_noted(const std::string& words) {
    for (const auto& entry : recording()) {
      if (entry.what == ports::TrafficKind::Note && entry.text.find(words) != std::string::npos)
        return true;
    }
    return false;
  }
  Result<ports::PortTransfer> send(const std::vector<std::string>& names) {
    std::vector<ports::ProgramChoice> choices;
    choices.reserve(names.size());
    for (const auto& name : names) choices.push_back({.program = name, .revision = {}});
    return ports_->send("com1", choices);
  }
};

/// CEN-202.
TEST_F(LineTransferTest, MakesAProgramOfEachONumberInATextAndLosesNothing) {
  add_mill({{"extract_programs", "yes"}});
  const std::string first = "%\n(SHIFT 2)\nO0101(FIRST)\nG0 X1\nM30\n";
  const std::string second = "O0102\nG0 X2 (O7 IN A COMMENT)\nM99\n\n";
  const std::string third = " o103\nM30\n%\n";
  line().write(first + second + third);
  ASSERT_TRUE(wait_stored("O103"));
  EXPECT_EQ(text_of("O0101"), first);
  EXPECT_EQ(text_of("O0102"), second);
  EXPECT_EQ(text_of("O103"), third);
  for (const std::string program : {"O0101", "O0102", "O103"}) {
    EXPECT_TRUE(store_->programs.revision(program, 1)->is_held) << program;
    EXPECT_EQ(store_->programs.revision(program, 1)->author, "machine mill");
  }
}

TEST_F(LineTransferTest, KeepsBlocksInFrontOfTheFirstONumber) {
  add_mill({{"extract_programs", "yes"}});
  line().write("%\nG0 X9\n:0104\nG0 X4\n%\n");
  ASSERT_TRUE(wait_stored("O0104"));
  EXPECT_EQ(text_of("mill-punched"), "%\nG0 X9\n");
  EXPECT_EQ(text_of("O0104"), ":0104\nG0 X4\n%\n");
}

TEST_F(LineTransferTest, KeepsBothOfTwoProgramsWithOneNumber) {
  add_mill({{"extract_programs", "yes"}});
  line().write("%\nO7\nG0 X1\nO7\nG0 X2\n%\n");
  ASSERT_TRUE(wait_stored("O7", 2));
  EXPECT_EQ(text_of("O7", 1), "%\nO7\nG0 X1\n");
  EXPECT_EQ(text_of("O7", 2), "O7\nG0 X2\n%\n");
}

TEST_F(LineTransferTest, KeepsOneTextWhereThePortDoesNotExtract) {
  add_mill({});
  line().write("%\nO1\nG0 X1\nO2\nG0 X2\n%\n");
  ASSERT_TRUE(wait_stored("O1"));
  EXPECT_EQ(text_of("O1"), "%\nO1\nG0 X1\nO2\nG0 X2\n%\n");
  EXPECT_FALSE(store_->programs.revision("O2", 1));
}

TEST_F(LineTransferTest, ExtractsUnlessItIsSaidOtherwiseOnLinesOfControlsWithONumbers) {
  for (const auto& row : wire::line_templates()) {
    const bool has_numbers = row.control == "centurion" || row.control == "fanuc";
    EXPECT_EQ(row.settings.extracts_programs, has_numbers) << row.name;
  }
}

TEST_F(LineTransferTest, KeepsTheWholeProgramsOfATextThatIsCutOff) {
  add_mill({{"extract_programs", "yes"}});
  line().write("%\nO11\nG0 X1\nO12\nG0 X");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->received > 19; }));
  line().pull();
  ASSERT_TRUE(wait([&] { return is_noted("cut off"); }));
  EXPECT_EQ(text_of("O11"), "%\nO11\nG0 X1\n");
  EXPECT_FALSE(store_->programs.revision("O12", 1));
}

TEST_F(LineTransferTest, MarksOnlyWhatCanBeDamagedAsDamaged) {
  add_mill({{"extract_programs", "yes"}});
  line().write("%\nO21\nG0 X1\nO22\nG0 X");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->received > 19; }));
  line().fault(wire::LineFault::Parity);
  line().write("1\nO23\nG0\nO24\nG0\n%\n");
  ASSERT_TRUE(wait_stored("O24"));
  const auto is_marked = [&](const std::string& program) {
    return store_->programs.revision(program, 1)->comment.find("DAMAGED") != std::string::npos;
  };
  EXPECT_FALSE(is_marked("O21"));
  EXPECT_TRUE(is_marked("O22"));
  EXPECT_FALSE(is_marked("O24"));
}

TEST_F(LineTransferTest, JudgesEachProgramOfATextByTheRules) {
  start_ports();
  add_machine("mill");
  auto port = mill("[[rule]]\nprogram = \"O9999\"\ntrigger = \"PRG\"\naction = \"send\"\n");
  port.settings.emplace_back("extract_programs", "yes");
  add_port(port);
  push("O1234", "N1 G0 X1\n");
  line().write("%\nO31\nM30\nO9999\n(PRG=1234)\n%\n");
  EXPECT_EQ(line().read_until("X1\n"), "N1 G0 X1\n");
  EXPECT_TRUE(wait_stored("O31"));
  EXPECT_FALSE(store_->programs.revision("O9999", 1));
}

/// CEN-200.
TEST_F(LineTransferTest, SendsSeveralProgramsAsOneText) {
  add_mill({{"start_char", "%"}, {"end_char", "%"}});
  push("O0001", "%\nO0001 (A)\nG0 X1\nM30\n%\n");
  push("15.nc", "(NO NUMBER)\nG0 X2\nM30");
  push("O0003", "\n(C)\n:3\nM99\n\n%");
  const auto sent = send({"O0001", "15.nc", "O0003"});
  ASSERT_TRUE(sent) << sent.error().what;
  EXPECT_EQ(sent->programs,
            (std::vector<std::string>{"O0001 revision 1", "15.nc revision 1", "O0003 revision 1"}));
  EXPECT_EQ(line().read_until("M99\n%"),
            "%\nO0001 (A)\nG0 X1\nM30\nO0015\n(NO NUMBER)\nG0 X2\nM30\n:3\n(C)\nM99\n%");
  ASSERT_TRUE(wait(
      [&] { return ports_->port("com1")->transfer->state == ports::TransferState::Completed; }));
  EXPECT_EQ(ports_->port("com1")->transfer->sent, sent->size);
  EXPECT_TRUE(wait([&] { return is_noted("completed"); }));
  EXPECT_TRUE(store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {})->empty())
      << "it is no run";
}

TEST_F(LineTransferTest, SendsOneProgramAsItIs) {
  add_mill({});
  push("table", "TOOL DATA\nT1 5.0\n");
  ASSERT_TRUE(send({"table"}));
  EXPECT_EQ(line().read_until("5.0\n"), "TOOL DATA\nT1 5.0\n");
}

TEST_F(LineTransferTest, SendsTheRevisionThatIsNamed) {
  add_mill({});
  push("O1", "O1\nG0 X1\n");
  push("O1", "O1\nG0 X2\n");
  ASSERT_TRUE(ports_->send("com1", {{.program = "O1", .revision = 1}}));
  EXPECT_EQ(line().read_until("X1\n"), "O1\nG0 X1\n");
}

TEST_F(LineTransferTest, ReportsWhichProgramCannotBeSentAndWhy) {
  add_mill({});
  push("O1", "O1\n");
  push("clamp", "G0 X1\n");
  push("empty", "%\n\n%\n");
  push("15.h", "0 BEGIN PGM 15 MM\n", "tnc155");
  const auto expect_refusal = [&](const std::vector<std::string>& names, Errc code,
                                  const std::string& words) {
    const auto sent = send(names);
    ASSERT_FALSE(sent) << words;
    EXPECT_EQ(sent.error().code, code) << sent.error().what;
    EXPECT_NE(sent.error().what.find(words), std::string::npos) << sent.error().what;
  };
  expect_refusal({}, Errc::Syntax, "no program");
  expect_refusal({"O1", "O2"}, Errc::NotFound, "O2");
  expect_refusal({"O1", "clamp"}, Errc::Syntax, "'clamp' has no O number");
  expect_refusal({"O1", "empty"}, Errc::Syntax, "'empty'");
  expect_refusal({"15.h"}, Errc::Unsupported, "tnc155");
  EXPECT_EQ(ports_->send("com9", {}).error().code, Errc::NotFound);
  EXPECT_FALSE(ports_->port("com1")->transfer) << "nothing was sent";
}

/// CEN-213.
TEST_F(LineTransferTest, RefusesInTheWordsOfTheControlToo) {
  add_mill({{"program_memory", "12"}});
  push("O1", "O1\nM30\n");
  push("clamp", "G0 X1\n");
  const auto expect_words = [&](const std::vector<std::string>& names, const std::string& words) {
    const auto sent = send(names);
    ASSERT_FALSE(sent) << words;
    EXPECT_NE(sent.error().what.find("(centurion error " + words + ")"), std::string::npos)
        << sent.error().what;
  };
  expect_words({}, "302: no programs to select from");
  expect_words({"O9"}, "603: program does not exist");
  expect_words({"O1", "clamp"}, "301: invalid program number");
  expect_words({"O1", "O1"}, "312: insufficient parts storage");
  ASSERT_TRUE(send({"O1"})) << "7 bytes fit into 12";
}

TEST_F(LineTransferTest, ReportsTheControlsOwnErrorNumbers) {
  start_ports();
  add_machine("mill");
  auto port = mill(
      "reply = \"O9998\"\n[[rule]]\ntrigger = \"PRG\"\naction = \"send\"\n[[rule]]\n"
      "trigger = \"DIR\"\naction = \"directory\"\n");
  add_port(port);
  line().write("%\nO9999\n(PRG=77)\nM30\n%\n");
  EXPECT_NE(line()
                .read_until("M30\n%\n")
                .find("(PROGRAM 77 IS NOT IN THE LIBRARY)\n(ERROR 603: PROGRAM DOES NOT EXIST)\n"),
            std::string::npos);
  line().write("%\nO9999\n(DIR)\nM30\n%\n");
  EXPECT_NE(line().read_until("M30\n%\n").find("(ERROR 302: NO PROGRAMS TO SELECT FROM)\n"),
            std::string::npos);
}

TEST_F(LineTransferTest, ATransferHoldsTheLineUntilItIsStopped) {
  add_mill({{"wait_for_xon", "yes"}});
  push("O1", "O1\nM30\n");
  ASSERT_TRUE(send({"O1"}));
  const auto run = start("O1");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Busy);
  EXPECT_NE(run.error().what.find("O1 revision 1"), std::string::npos) << run.error().what;
  EXPECT_EQ(send({"O1"}).error().code, Errc::Busy);
  EXPECT_EQ(ports_->remove("com1").error().code, Errc::Busy);
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  ASSERT_TRUE(
      wait([&] { return ports_->port("com1")->transfer->state == ports::TransferState::Aborted; }));
  EXPECT_EQ(ports_->port("com1")->transfer->reason, "stopped by cam; no whole block was sent");
  EXPECT_EQ(ports_->stop_transfer("com1", "again").error().code, Errc::Conflict);
  EXPECT_TRUE(wait([&] { return start("O1").has_value(); }));
}

class XmodemTransferTest : public LineTransferTest {
 protected:
  void add_control() {
    add_mill({{"flow", "xmodem"}, {"extract_programs", "yes"}});
    control_ = std::make_unique<PlayedControl>(ports_->port("com1")->settings, line());
  }
  std::unique_ptr<PlayedControl> control_;
};

/// CEN-200, CEN-202.
TEST_F(XmodemTransferTest, ReceivesWhatItAsksTheControlFor) {
  add_control();
  ASSERT_TRUE(ports_->receive("com1"));
  EXPECT_EQ(ports_->receive("com1").error().code, Errc::Busy);
  const std::string first = "O51\n" + blocks(40);
  ASSERT_TRUE(control_->send(first + "O52\nG0 X1\n", ""));
  ASSERT_TRUE(control_->until([&] { return store_->programs.revision("O52", 1).has_value(); }));
  EXPECT_EQ(text_of("O51"), first);
  EXPECT_EQ(text_of("O52"), "O52\nG0 X1\n");
  EXPECT_TRUE(store_->programs.revision("O51", 1)->is_held);
}

TEST_F(XmodemTransferTest, TakesForAProgramWhateverItAskedFor) {
  add_control();
  ASSERT_TRUE(ports_->receive("com1"));
  ASSERT_TRUE(control_->send("X1 Y2\nX3\n", ""));
  ASSERT_TRUE(
      control_->until([&] { return store_->programs.revision("mill-punched", 1).has_value(); }));
  EXPECT_EQ(text_of("mill-punched"), "X1 Y2\nX3\n");
}

TEST_F(XmodemTransferTest, CanBeStoppedFromAsking) {
  add_control();
  ASSERT_TRUE(ports_->receive("com1"));
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  push("O1", "O1\nM30\n");
  const auto run = start("O1");
  EXPECT_TRUE(run) << run.error().what;
}

TEST_F(LineTransferTest, AsksNoControlThatSendsUnasked) {
  add_mill({});
  const auto begun = ports_->receive("com1");
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace dripline::server_test
