// `dnc edit`, `dnc check --to` and what `dnc check` says of the control's memory.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::FakeServer;

const std::string kProgram =
    "0 BEGIN PGM 15 MM\n"
    "1 TOOL DEF 1 L+0,000 R+5,000\n"
    "2 TOOL CALL 1 Z S500,000\n"
    "3 L X+10,000 Y+20,000 R0 F15999 M03\n"
    "4 L Z-5,000 R F100 M08\n"
    "5 L X+40,000 R F200 M\n"
    "6 END PGM 15 MM\n";

class DncEdit : public testing::Test {
 protected:
  test_support::Dnc dnc{DNC_PATH};
};

// HD-061
TEST_F(DncEdit, ChangesAFileByBlockNumbersAndShowsWhat) {
  dnc.write("15.h", kProgram);
  const auto edited = dnc({"edit", "15.h", "--delete", "4", "--insert-after", "5", "LZ-2F50",
                           "--insert-after", "5", "STOP"});
  EXPECT_EQ(edited.status, 0) << edited.err;
  EXPECT_EQ(edited.out,
            "-4 L Z-5,000 R F100 M08\n+5 L Z-2,000 R F50 M\n+6 STOP M\n2 blocks renumbered\n"
            "Wrote 15.h.\n");
  EXPECT_EQ(dnc.read("15.h"),
            "0 BEGIN PGM 15 MM\n"
            "1 TOOL DEF 1 L+0,000 R+5,000\n"
            "2 TOOL CALL 1 Z S500,000\n"
            "3 L X+10,000 Y+20,000 R0 F15999 M03\n"
            "4 L X+40,000 R F200 M\n"
            "5 L Z-2,000 R F50 M\n"
            "6 STOP M\n"
            "7 END PGM 15 MM\n");
}

// CEN-209
TEST_F(DncEdit, CopiesAndMovesBlocks) {
  const std::string lines = "O1\nG1 X1\nG1 X2\nG1 X3\nM30\n";
  dnc.write("O1.nc", lines);
  const auto moved = dnc({"edit", "O1.nc", "--control", "centurion", "--move", "2..3", "4"});
  EXPECT_EQ(moved.status, 0) << moved.err;
  EXPECT_EQ(moved.out, "-G1 X1\n-G1 X2\n+G1 X1\n+G1 X2\nWrote O1.nc.\n");
  EXPECT_EQ(dnc.read("O1.nc"), "O1\nG1 X3\nG1 X1\nG1 X2\nM30\n");
  EXPECT_EQ(dnc({"edit", "O1.nc", "--control", "centurion", "--copy", "2", "4"}).status, 0);
  EXPECT_EQ(dnc.read("O1.nc"), "O1\nG1 X3\nG1 X1\nG1 X2\nG1 X3\nM30\n");
  const auto itself = dnc({"edit", "O1.nc", "--control", "centurion", "--move", "2..4", "3"});
  EXPECT_EQ(itself.status, 1);
  EXPECT_EQ(itself.err, "dnc: --move 2..4 3: block 3 is moved itself\n");
  const auto absent = dnc({"edit", "O1.nc", "--control", "centurion", "--copy", "9", "3"});
  EXPECT_NE(absent.err.find("block 9 is not there"), std::string::npos) << absent.err;
  EXPECT_EQ(dnc.read("O1.nc"), "O1\nG1 X3\nG1 X1\nG1 X2\nG1 X3\nM30\n");
}

TEST_F(DncEdit, NumbersTheBlocksThatItCopiesAndMoves) {
  dnc.write("15.h", kProgram);
  const auto edited = dnc({"edit", "15.h", "--move", "4", "5", "--copy", "2", "5"});
  EXPECT_EQ(edited.status, 0) << edited.err;
  EXPECT_EQ(dnc.read("15.h"),
            "0 BEGIN PGM 15 MM\n"
            "1 TOOL DEF 1 L+0,000 R+5,000\n"
            "2 TOOL CALL 1 Z S500,000\n"
            "3 L X+10,000 Y+20,000 R0 F15999 M03\n"
            "4 L X+40,000 R F200 M\n"
            "5 TOOL CALL 1 Z S 500,000\n"
            "6 L Z-5,000 R F100 M08\n"
            "7 END PGM 15 MM\n");
  const auto frame = dnc({"edit", "15.h", "--copy", "0", "3"});
  EXPECT_NE(frame.err.find("a program begins and ends once"), std::string::npos) << frame.err;
}

// HD-061
TEST_F(DncEdit, LeavesTheFileAsItIsWhenTheControlRefusesABlock) {
  dnc.write("15.h", kProgram);
  const auto refused = dnc({"edit", "15.h", "--replace", "4", "L X+1,0,0"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("\"L X+1,0,0\", column "), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("BLOCK FORMAT INCORRECT"), std::string::npos) << refused.err;
  EXPECT_EQ(dnc.read("15.h"), kProgram);
  EXPECT_EQ(dnc({"edit", "15.h", "--delete", "5", "--dry-run"}).status, 0);
  EXPECT_EQ(dnc.read("15.h"), kProgram);
  const auto nothing = dnc({"edit", "15.h"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_EQ(dnc({"edit", "15.h", "--delete", "x"}).err,
            "dnc: 'x' names no blocks: expected a number as 7, or several as 5..7\n");
}

// HD-056, HD-066
TEST_F(DncEdit, ProtectsAndRenumbers) {
  dnc.write("15.h", kProgram);
  ASSERT_EQ(dnc({"edit", "15.h", "--protect"}).status, 0);
  EXPECT_TRUE(dnc.read("15.h").starts_with("0 BEGIN PGM 15 MM P"));
  const auto refused = dnc({"edit", "15.h", "--delete", "4"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err,
            "dnc: 15.h is protected against editing; --unprotect lifts that, --force edits it all "
            "the same\n");
  EXPECT_EQ(dnc({"edit", "15.h", "--delete", "4", "--force"}).status, 0);
  EXPECT_EQ(dnc({"edit", "15.h", "--delete", "4", "--unprotect"}).status, 0);
  EXPECT_TRUE(dnc.read("15.h").starts_with("0 BEGIN PGM 15 MM\r\n")) << dnc.read("15.h");
  dnc.write("16.i", "%16 G71 *\nN1 G29 *\nN2 L5 *\nN9999 %16 G71 *\n");
  ASSERT_EQ(dnc({"edit", "16.i", "--renumber", "20", "--delete", "1"}).status, 0);
  EXPECT_EQ(dnc.read("16.i"), "%16 G71 *\r\nN20 L5 *\r\nN9999 %16 G71 *\r\n");
}

// HD-064, HD-065
TEST_F(DncEdit, ChangesWordsOfBlocks) {
  dnc.write("15.h", kProgram);
  const auto edited =
      dnc({"edit", "15.h", "--set", "3", "X+12.5", "--set", "3", "F MAX", "--leave-out", "4", "M",
           "--shorten", "5", "F", "--insert-after", "5", "STOP"});
  EXPECT_EQ(edited.status, 0) << edited.err;
  EXPECT_EQ(edited.out,
            "-3 L X+10,000 Y+20,000 R0 F15999 M03\n+3 L X+12,500 Y+20,000 R0 F MAX M03\n"
            "-4 L Z-5,000 R F100 M08\n+4 L Z-5,000 R F100 M\n"
            "-5 L X+40,000 R F200 M\n+5 L X+40,000 R F M\n+6 STOP M\n"
            "1 blocks renumbered\nWrote 15.h.\n");
  // What is left out stays as it is in force: 100 mm/min also in block 5.
  const auto checked = json::parse(dnc({"check", "--to", "5", "--json", "15.h"}).out);
  EXPECT_EQ(checked.at("stopped").at("feed"), "100.0 mm/min");
}

// HD-064, HD-065
TEST_F(DncEdit, RefusesWordsInTheControlsWordsAndChangesNothing) {
  dnc.write("15.h", kProgram);
  const auto missing = dnc({"edit", "15.h", "--set", "3", "X+1", "--set", "4", "Y+5"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_EQ(missing.err, "dnc: block 4 has no word Y: \"L Z-5,000 R F100 M08\"\n");
  const auto range = dnc({"edit", "15.h", "--set", "4", "F16000"});
  EXPECT_EQ(range.status, 1);
  EXPECT_NE(range.err.find("F 16000 is not a whole number within 0 to 15999"), std::string::npos)
      << range.err;
  EXPECT_EQ(dnc({"edit", "15.h", "--set", "3..4", "F1"}).err,
            "dnc: --set 3..4: expected one block\n");
  EXPECT_EQ(dnc({"edit", "15.h", "--set", "4", "F1", "--delete", "4"}).err,
            "dnc: block 4 is taken out or replaced twice\n");
  EXPECT_EQ(dnc({"edit", "15.h", "--leave-out", "4", "F", "--find", "X"}).status, 2);
  EXPECT_EQ(dnc.read("15.h"), kProgram);
  dnc.write("a.nc", "G90\nG0 X1\nM30\n");
  EXPECT_EQ(dnc({"edit", "a.nc", "--control", "fanuc", "--set", "2", "X2"}).status, 2);
  EXPECT_EQ(dnc({"edit", "a.nc", "--control", "fanuc", "--find", "X"}).status, 2);
  ASSERT_EQ(dnc({"edit", "15.h", "--protect"}).status, 0);
  EXPECT_EQ(dnc({"edit", "15.h", "--set", "4", "F50"}).status, 1);
  EXPECT_EQ(dnc({"edit", "15.h", "--set", "4", "F50", "--force"}).status, 0);
}

// HD-062
TEST_F(DncEdit, ShowsOnlyTheBlocksThatHaveAnAddress) {
  dnc.write("15.h", kProgram);
  ASSERT_EQ(dnc({"edit", "15.h", "--protect"}).status, 0);
  const std::string before = dnc.read("15.h");
  const auto found = dnc({"edit", "15.h", "--find", "X"});
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_EQ(found.out, "3 L X+10,000 Y+20,000 R0 F15999 M03\n5 L X+40,000 R F200 M\n");
  const auto none = dnc({"edit", "15.h", "--find", "IX", "--find", "LBL"});
  EXPECT_EQ(none.out, "No block has IX or LBL.\n");
  EXPECT_EQ(none.status, 1);
  const auto shown = json::parse(dnc({"edit", "15.h", "--find", "tool call", "--json"}).out);
  EXPECT_EQ(shown, json::parse(R"({"blocks":[{"block":2,"line":3,
      "text":"2 TOOL CALL 1 Z S 500,000"}],"unread":[]})"));
  EXPECT_EQ(dnc({"edit", "15.h", "--find", "E"}).err, "dnc: \"E\" is no word of plain language\n");
  EXPECT_EQ(dnc.read("15.h"), before);
  dnc.write("16.h", "0 BEGIN PGM 16 MM\n1 L Q\n2 L X+1\n3 END PGM 16 MM\n");
  const auto wrong = dnc({"edit", "16.h", "--find", "X"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(wrong.out, "2 L X+1\n");
  EXPECT_TRUE(wrong.err.starts_with("dnc: line 2, \"1 L Q\" cannot be read: BLOCK FORMAT"))
      << wrong.err;
}

// HD-066, HD-081: without a step it is that of the control's MOD menu.
TEST_F(DncEdit, RenumbersByTheSetupsIncrement) {
  dnc.write("16.i", "%16 G71 *\nN1 G29 *\nN2 L5 *\nN9999 %16 G71 *\n");
  dnc.write("mod.toml", "[control]\nblock_increment = 7\n");
  ASSERT_EQ(dnc({"edit", "16.i", "--setup", "mod.toml", "-o", "17.i", "--renumber"}).status, 0);
  EXPECT_EQ(dnc.read("17.i"), "%16 G71 *\r\nN7 G29 *\r\nN14 L5 *\r\nN9999 %16 G71 *\r\n");
  ASSERT_EQ(dnc({"edit", "16.i", "--setup", "mod.toml", "--renumber", "5"}).status, 0);
  EXPECT_EQ(dnc.read("16.i"), "%16 G71 *\r\nN5 G29 *\r\nN10 L5 *\r\nN9999 %16 G71 *\r\n");
  dnc.write("wrong.toml", "[control]\nblock_increment = 100\n");
  const auto refused = dnc({"edit", "17.i", "--setup", "wrong.toml", "--renumber"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.err, "dnc: wrong.toml: option block_increment: 100 is not 0 to 99\n");
  EXPECT_TRUE(dnc.read("17.i").starts_with("%16 G71 *\r\nN7 ")) << "nothing was written";
}

TEST_F(DncEdit, GoesByLinesForOtherControls) {
  dnc.write("a.nc", "G90\nG0 X1\nM30\n");
  const auto edited = dnc({"edit", "a.nc", "--control", "fanuc", "--replace", "2", "G0 X2",
                           "--insert-after", "0", "O1", "-o", "b.nc", "--json"});
  EXPECT_EQ(edited.status, 0) << edited.err;
  EXPECT_EQ(dnc.read("a.nc"), "G90\nG0 X1\nM30\n");
  EXPECT_EQ(dnc.read("b.nc"), "O1\nG90\nG0 X2\nM30\n");
  const auto shown = json::parse(edited.out);
  EXPECT_EQ(shown.at("written"), "b.nc");
  EXPECT_EQ(shown.at("changes").size(), 3u);
  EXPECT_EQ(shown.at("changes").at(1), json::parse(R"({"mark":"-","block":"G0 X1"})"));
  EXPECT_EQ(dnc({"edit", "a.nc", "--control", "fanuc", "--renumber"}).status, 2);
}

// CEN-209
TEST_F(DncEdit, FindsAndChangesTextsOfLines) {
  const std::string program = "O0001\nT0101\nG1 X1\nG10 X2\nt0101\n";
  dnc.write("O0001", program);
  const std::vector<std::string> edit{"edit", "O0001", "--control", "centurion"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), edit.begin(), edit.end());
    return dnc(more);
  };
  EXPECT_EQ(with({"--find-text", "G1", "--whole-words"}).out, "3: G1 X1\n");
  EXPECT_EQ(with({"--find-text", "G1"}).status, 0);
  const auto none = with({"--find-text", "M30"});
  EXPECT_EQ(none.out, "No line has M30.\n");
  EXPECT_EQ(none.status, 1) << "as grep";
  EXPECT_EQ(with({"--find-text", "M30", "--json"}).status, 1);
  EXPECT_EQ(with({"--find-text", "M30", "--find-text", "G1"}).status, 0) << "one of them is there";
  const auto shown = with({"--find-text", "G1", "--within", "4..5", "--json"});
  EXPECT_EQ(json::parse(shown.out).at("blocks"),
            json::parse(R"([{"block":4,"line":4,"text":"G10 X2"}])"));
  EXPECT_EQ(with({"--change", "M30", "M2"}).status, 1);
  EXPECT_EQ(with({"--find-text", "G1", "--change", "G1", "G0"}).status, 2);
  EXPECT_EQ(with({"--ignore-case", "--delete", "1"}).status, 2);
  EXPECT_EQ(dnc.read("O0001"), program) << "nothing was written";
  const auto changed = with({"--change", "T0101", "T0202", "--ignore-case"});
  EXPECT_EQ(changed.status, 0) << changed.err;
  EXPECT_EQ(dnc.read("O0001"), "O0001\nT0202\nG1 X1\nG10 X2\nT0202\n");
}

// HD-061
TEST_F(DncEdit, LeavesTextSearchToControlsThatKeepLines) {
  dnc.write("15.h", kProgram);
  const auto refused = dnc({"edit", "15.h", "--change", "F200", "F300"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "dnc: 15.h: its control keeps numbered blocks of words: use --find and --set\n");
  EXPECT_EQ(dnc.read("15.h"), kProgram);
}

// HD-061
TEST_F(DncEdit, StoresANewRevisionOfAProgramOnTheServer) {
  FakeServer server;
  dnc.environment["DRIPLINE_SERVER"] = server.url();
  dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
  server.add_program("15.h", kProgram);
  const auto edited = dnc({"edit", "--program", "15.h", "--control", "tnc155", "--delete", "3..5"});
  EXPECT_EQ(edited.status, 0) << edited.err;
  EXPECT_NE(edited.out.find("Wrote 15.h revision 2.\n"), std::string::npos) << edited.out;
  EXPECT_EQ(server.revisions("15.h"), 2u);
  EXPECT_EQ(server.content("15.h"),
            "0 BEGIN PGM 15 MM\n1 TOOL DEF 1 L+0,000 R+5,000\n2 TOOL CALL 1 Z S500,000\n"
            "3 END PGM 15 MM\n");
}

// HD-062, HD-064
TEST_F(DncEdit, SearchesAndChangesWordsOnTheServer) {
  FakeServer server;
  dnc.environment["DRIPLINE_SERVER"] = server.url();
  dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
  server.add_program("15.h", kProgram);
  EXPECT_EQ(dnc({"edit", "--program", "15.h", "--control", "tnc155", "--find", "S"}).out,
            "2 TOOL CALL 1 Z S500,000\n");
  EXPECT_EQ(server.revisions("15.h"), 1u);
  const auto edited =
      dnc({"edit", "--program", "15.h", "--control", "tnc155", "--set", "2", "S650"});
  EXPECT_EQ(edited.status, 0) << edited.err;
  EXPECT_EQ(server.revisions("15.h"), 2u);
  EXPECT_NE(server.content("15.h").find("\n2 TOOL CALL 1 Z S 650,000\n3 "), std::string::npos)
      << server.content("15.h");
}

// HD-196: 10 to 40 is the move of block 5, which is not made; 100 mm/min down to -5.
TEST_F(DncEdit, ChecksUpToABlockAndSaysHowTheMachineStandsThere) {
  dnc.write("15.h", kProgram);
  const auto checked = dnc({"check", "--to", "4", "15.h", "--json"});
  EXPECT_EQ(checked.status, 0) << checked.err;
  const auto report = json::parse(checked.out);
  EXPECT_FALSE(report.at("ended"));
  EXPECT_EQ(report.at("stopped"), json::parse(R"({"block":4,"line":5,
      "position":{"X":10.0,"Y":20.0,"Z":-5.0},"tool":1,"spindle":"cw","speed":500.0,
      "feed":"100.0 mm/min","flood":true,"mist":false})"));
  EXPECT_NE(dnc({"check", "--to", "N4", "15.h"}).out.find("15.h: comes to block 4 in line 5\n"),
            std::string::npos);
  EXPECT_EQ(dnc({"check", "--to", "L6", "15.h"}).status, 0);
  const auto never = dnc({"check", "--to", "70", "15.h"});
  EXPECT_EQ(never.status, 1);
  EXPECT_EQ(never.err, "dnc: 15.h: block 70 is not reached before the end of the program\n");
  EXPECT_EQ(dnc({"check", "--to", "Z", "15.h"}).status, 2);
}

// HD-196: the corner of blocks 2 and 3 is known from block 3 only, and block 4 is wrong.
TEST_F(DncEdit, ChecksUpToABlockThatWaitsForItsSuccessor) {
  dnc.write("7.h",
            "0 BEGIN PGM 7 MM\n1 TOOL DEF 1 L+0 R+2\n2 TOOL CALL 1 Z S500\n"
            "3 L X+0 Y+0 RL F100 M03\n4 L X+20\n5 L Y+20\n6 L Q\n");
  const auto report = json::parse(dnc({"check", "--to", "4", "7.h", "--json"}).out);
  ASSERT_TRUE(report.contains("stopped")) << report.dump();
  EXPECT_EQ(report.at("stopped").at("block"), 4);
  EXPECT_EQ(report.at("stopped").at("position").at("X"), 18.0);
  EXPECT_EQ(report.at("alarm"), nullptr);
  EXPECT_EQ(dnc({"check", "--to", "6", "7.h"}).status, 1);
}

// HD-052: 3101 blocks in transit are well, and too many for the control's memory.
TEST_F(DncEdit, WarnsOfAProgramThatTheControlCouldNotKeep) {
  std::string text = "0 BEGIN PGM 15 MM\n";
  for (int i = 1; i < 1500; ++i) text += std::to_string(i) + " CC\n";
  dnc.write("15.h", text + "1500 END PGM 15 MM\n");
  const auto warned = dnc({"check", "15.h"});
  EXPECT_EQ(warned.status, 0) << warned.err;
  EXPECT_NE(warned.out.find("15.h:1: warning TNC-MEMORY: PROGRAM MEMORY EXCEEDED: program 15 has "
                            "1501 blocks, 999 is most"),
            std::string::npos)
      << warned.out;
  dnc.write("kept.toml", "[control]\nmemory_limits = true\n");
  const auto refused = dnc({"check", "--setup", "kept.toml", "15.h"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.out.find("15.h:1: alarm TNC-MEMORY: PROGRAM MEMORY EXCEEDED: "),
            std::string::npos)
      << refused.out;
}

}  // namespace
}  // namespace dripline
