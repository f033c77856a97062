#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/core.h>

#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

// HD-146: REP 3 plays the part four times; HD-147: LBL 0 within it means nothing.
TEST(TncFlow, ARepeatPlaysItsPartOnceMoreThanItSays) {
  EXPECT_THAT(moves_of({"LBL 1", "L IX+1 R0 F MAX", "LBL 0", "CALL LBL 1 REP 3/3", "L X+9 F MAX"}),
              ElementsAre("R X1", "R X2", "R X3", "R X4", "R X9"));
  EXPECT_THAT(moves_of({"LBL 1", "L IX+1 R0 F MAX", "CALL LBL 1 REP 0/0"}), ElementsAre("R X1"));
}

// HD-146: an inner repeat starts again with each pass of the outer one: 2 * 3.
TEST(TncFlow, RepeatsNest) {
  EXPECT_EQ(moves_of({"LBL 15", "LBL 17", "L IX+1 R0 F MAX", "CALL LBL 17 REP 2/2",
                      "CALL LBL 15 REP 1/1"})
                .back(),
            "R X6");
}

// HD-145, HD-152: to LBL 0 and back; a repeat of the call runs it three times.
TEST(TncFlow, SubprogramsComeBack) {
  EXPECT_THAT(
      moves_of({"LBL 2", "CALL LBL 5 REP", "CALL LBL 2 REP 2/2", "L Y+1 R0 F MAX", "STOP M02",
                "LBL 5", "L IX+1 R0 F MAX", "CALL LBL 6 REP", "LBL 0", "LBL 6", "L IZ+1 R0 F MAX",
                "LBL 0"}),
      ElementsAre("R X1", "R X1 Z1", "R X2 Z1", "R X2 Z2", "R X3 Z2", "R X3 Z3", "R X3 Y1 Z3"));
}

// HD-145: met without a call it is run through.
TEST(TncFlow, ASubprogramInTheWayIsRunThrough) {
  EXPECT_THAT(moves_of({"LBL 5", "L IX+1 R0 F MAX", "LBL 0", "L IX+1 F MAX"}),
              ElementsAre("R X1", "R X2"));
}

// HD-151, HD-198: without LBL 0 the call meets itself; the ninth level is refused.
TEST(TncFlow, ACallWithinItselfEndsAtEightLevels) {
  const auto run = run_blocks({"LBL 1", "L IX+1 R0 F MAX", "CALL LBL 1 REP"});
  EXPECT_EQ(run.alarm_id, "TNC-NESTING");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_EQ(run.events.size(), 10u) << "nine passes and the alarm";
}

// HD-148: eight levels are allowed.
TEST(TncFlow, LabelsNestEightDeep) {
  const auto nested = [](int levels) {
    std::vector<std::string> blocks{"CALL LBL 1 REP", "STOP M02"};
    for (int level = 1; level <= levels; ++level) {
      blocks.push_back(fmt::format("LBL {}", level));
      blocks.push_back(level == levels ? "L IX+1 R0 F MAX"
                                       : fmt::format("CALL LBL {} REP", level + 1));
      blocks.push_back("LBL 0");
    }
    return moves_of(blocks);
  };
  EXPECT_THAT(nested(8), ElementsAre("R X1"));
  EXPECT_THAT(nested(9), ElementsAre("! EXCESSIVE SUBPROGRAMMING"));
}

// HD-144, HD-153
TEST(TncFlow, LabelsAreSetOnceAndFound) {
  EXPECT_THAT(moves_of({"L X+1 R0 F MAX", "LBL 4", "LBL 4"}),
              ElementsAre("! NUMBER ALREADY ALLOCATED"));
  const PathSetup at_call{"[control]\nprogram_check = \"call\"\n", {}};
  EXPECT_THAT(moves_of({"L X+1 R0 F MAX", "LBL 4", "L X+2 F MAX", "LBL 4"}, at_call),
              ElementsAre("R X1", "R X2", "! NUMBER ALREADY ALLOCATED"));
  EXPECT_THAT(
      moves_of({"L X+1 R0 F MAX", "CALL LBL 4 REP", "L X+2 F MAX", "LBL 4", "LBL 0", "LBL 4"},
               at_call),
      ElementsAre("R X1", "! NUMBER ALREADY ALLOCATED"))
      << "before the jump";
  EXPECT_THAT(moves_of({"CALL LBL 7 REP"}), ElementsAre("! LBL NUMBER NOT FOUND"));
  EXPECT_THAT(moves_of({"CALL LBL 0 REP"}), ElementsAre("! JUMP TO LABEL 0 NOT PERMITTED"));
  EXPECT_THAT(moves_of({"FN 9: IF +0 EQU +0 GOTO LBL 0"}),
              ElementsAre("! JUMP TO LABEL 0 NOT PERMITTED"));
}

// HD-149: labels are those of the called program; M02 in it goes back; parameters are shared.
TEST(TncFlow, ProgramsAreCalled) {
  PathSetup library;
  library.programs = {{"7",
                       "0 BEGIN PGM 7 MM\n1 LBL 1\n2 L IX+Q1 R0 F MAX\n"
                       "3 CALL LBL 1 REP 1/1\n4 STOP M02\n5 L X+99 F MAX\n6 END PGM 7 MM\n"}};
  const auto run = run_blocks(
      {"FN 0: Q1 = +2", "LBL 1", "L IY+1 R0 F MAX", "CALL PGM 7", "L IY+1 F MAX"}, library);
  EXPECT_THAT(run.events,
              ElementsAre("R Y1", "R X2 Y1", "R X4 Y1", "R X4 Y2", testing::StartsWith("end ")));
}

// HD-149: a program in inches called from one in millimeters reads its own numbers as inches.
TEST(TncFlow, ACalledProgramHasItsOwnUnits) {
  PathSetup library;
  library.programs = {{"7", "0 BEGIN PGM 7 INCH\n1 L X+1 R0 F MAX\n2 END PGM 7 INCH\n"}};
  const auto run = run_blocks({"L Y+1 R0 F MAX", "CALL PGM 7", "L X+1 F MAX"}, library);
  EXPECT_THAT(run.events, ElementsAre("R Y1", "units inch", "R X25.4 Y1", "units mm", "R X1 Y1",
                                      testing::StartsWith("end ")));
}

// HD-149, HD-038: in a called program nothing is preset, and the caller finds its own G functions
// again; a control may also keep one set of them for all programs.
TEST(TncFlow, EveryProgramHasItsOwnModes) {
  const std::string main =
      "%3 G71 *\nN1 G17 G40 G90 G00 X+10 *\nN2 %7 *\nN3 X+20 *\nN9999 %3 G71 *\n";
  PathSetup library;
  library.programs = {{"7", "%7 G71 *\nN1 G17 G40 G91 G01 X+5 F90 *\nN9999 %7 G71 *\n"}};
  EXPECT_THAT(run_text(main, library).events,
              ElementsAre("R X10", "L X15 F90", "R X20", testing::StartsWith("end")));
  PathSetup together = library;
  together.setup = "[control]\niso_modes = \"run\"";
  EXPECT_THAT(run_text(main, together).events,
              ElementsAre("R X10", "L X15 F90", "L X35 F90", testing::StartsWith("end")));
  library.programs = {{"7", "%7 G71 *\nN1 X+5 *\nN9999 %7 G71 *\n"}};
  EXPECT_EQ(run_text(main, library).alarm_id, "TNC-START-UNDEFINED");
  library.setup = together.setup;
  EXPECT_THAT(run_text(main, library).events,
              ElementsAre("R X10", "R X5", "R X20", testing::StartsWith("end")));
}

// HD-149: four levels; HD-150
TEST(TncFlow, ProgramsNestFourDeep) {
  PathSetup library;
  for (int level = 2; level <= 6; ++level) {
    library.programs.emplace_back(
        fmt::format("{}", level),
        fmt::format("0 BEGIN PGM {0} MM\n1 L IX+1 R0 F MAX\n2 CALL PGM {1}\n3 END PGM {0} MM\n",
                    level, level + 1));
  }
  EXPECT_EQ(moves_of({"CALL PGM 2"}, library).back(), "! EXCESSIVE SUBPROGRAMMING");
  library.programs[3].second = "0 BEGIN PGM 5 MM\n1 L IX+1 R0 F MAX\n2 END PGM 5 MM\n";
  EXPECT_EQ(moves_of({"CALL PGM 2"}, library).back(), "R X4");
}

// HD-150: when the program is started, also where the call would never be reached; what is called
// in a called program when that comes to it.
TEST(TncFlow, MissingProgramsAreComplainedOfAtTheStart) {
  const auto run = run_blocks({"L X+1 R0 F MAX", "STOP M02", "CALL PGM 15"});
  EXPECT_THAT(run.events, ElementsAre("! PGM 15 UNAVAILABLE"));
  EXPECT_EQ(run.alarm_id, "TNC-PGM-UNAVAILABLE");
  EXPECT_EQ(run.alarm_line, 4u);
  EXPECT_THAT(moves_of({"L X+1 R0 F MAX", "CYCL DEF 12.0 PGM CALL", "CYCL DEF 12.1 PGM 16"}),
              ElementsAre("! PGM 16 UNAVAILABLE"));
  EXPECT_THAT(run_text("%3 G71 *\nN1 G17 G40 G90 G00 X+1 *\nN2 %17 *\nN9999 %3 G71 *\n").events,
              ElementsAre("! PGM 17 UNAVAILABLE"));
  PathSetup library;
  library.programs = {{"7", "0 BEGIN PGM 7 MM\n1 CALL PGM 8\n2 END PGM 7 MM\n"}};
  EXPECT_THAT(moves_of({"L X+1 R0 F MAX", "CALL PGM 7"}, library),
              ElementsAre("R X1", "! PGM 8 UNAVAILABLE"));
}
// HD-150: a slow line need not bring the whole program first.
TEST(TncFlow, MissingProgramsMayBeLeftToTheCall) {
  EXPECT_THAT(
      moves_of({"L X+1 R0 F MAX", "CALL PGM 15"}, {"[control]\nprogram_check = \"call\"", {}}),
      ElementsAre("R X1", "! PGM 15 UNAVAILABLE"));
}

// HD-187, HD-033: a program's number has up to eight digits, in P01 as well.
TEST(TncFlow, ACycleInIsoCallsAProgramOfEightDigits) {
  PathSetup library;
  library.programs = {{"12345678",
                       "0 BEGIN PGM 12345678 MM\n1 L IZ-1 R0 F MAX\n"
                       "2 END PGM 12345678 MM\n"}};
  const std::string head = "%3 G71 *\nN1 G39 P01 ";
  const std::string rest = " *\nN2 G17 G40 G90 G00 X+1 M99 *\nN9999 %3 G71 *\n";
  EXPECT_THAT(run_text(head + "12345678" + rest, library).events,
              ElementsAre("R X1", "R X1 Z-1", testing::StartsWith("end")));
  EXPECT_THAT(run_text(head + "87654321" + rest, library).events,
              ElementsAre("! PGM 87654321 UNAVAILABLE"));
}

// HD-034, HD-035, HD-144: several ISO blocks stand in one line.
TEST(TncFlow, LabelsAfterOtherBlocksOfTheirLineAreFound) {
  EXPECT_THAT(run_text("%3 G71 *\nN10 G17 G40 G90 G00 X+1 *\nN20 L5 * N25 X+7 * N30 M02 *\n"
                       "N40 X+50 * N50 G98 L5 * N60 Y+9 *\nN70 G98 L0 *\nN9999 %3 G71 *\n")
                  .events,
              ElementsAre("R X1", "R X1 Y9", "R X7 Y9", testing::StartsWith("end")));
  EXPECT_THAT(run_text("%3 G71 *\nN10 G17 G40 G91 G00 X+1 * N20 G98 L4 * N30 X+1 * N40 L4.2 *\n"
                       "N9999 %3 G71 *\n")
                  .events,
              ElementsAre("R X1", "R X2", "R X3", "R X4", testing::StartsWith("end")));
}

// HD-028, HD-144: without continuation every line of an ISO program is a block, for a jump as well.
TEST(TncFlow, JumpsFollowTheContinuationOfLines) {
  const std::string text =
      "%3 G71\nN10 G17 G40 G90 G00 X+1\nN20 L5\nN30 M02\nN40 X+50\nG98 L5\nY+9\nG98 L0\n";
  EXPECT_THAT(run_text(text, {"[control]\niso_continuation = false", {}}).events,
              ElementsAre("R X1", "R X1 Y9", testing::StartsWith("end")));
}

// HD-187, HD-137: the moves of the program that cycle 12 calls do not call it again; after it M89
// continues.
TEST(TncFlow, M89RestsWithinTheProgramOfACycle) {
  PathSetup library;
  library.programs = {{"7",
                       "0 BEGIN PGM 7 MM\n1 L IZ-1 R0 F MAX\n2 L IZ+1 F MAX\n"
                       "3 END PGM 7 MM\n"}};
  EXPECT_THAT(moves_of({"CYCL DEF 12.0 PGM CALL", "CYCL DEF 12.1 PGM 7", "L X+1 R0 F MAX M89",
                        "L X+2 F MAX", "L X+3 F MAX M99", "L X+4 F MAX"},
                       library),
              ElementsAre("R X1", "R X2", "R X2 Z-1", "R X2 Z0", "R X3 Z0", "R X3 Z-1", "R X3 Z0",
                          "R X4 Z0"));
}

// Block numbers are only checked where the setup says so, and a jump begins a new count.
TEST(TncFlow, BlockNumbersMayHaveToFollowOneAnother) {
  const PathSetup strict{"[control]\nstrict_numbers = true", {}};
  const std::string gap = "0 BEGIN PGM 1 MM\n1 L X+1 R0 F MAX\n3 L X+2 F MAX\n4 END PGM 1 MM\n";
  EXPECT_THAT(run_text(gap).events, ElementsAre("R X1", "R X2", testing::StartsWith("end")));
  const auto refused = run_text(gap, strict);
  EXPECT_THAT(refused.events, ElementsAre("R X1", "! BLOCK NUMBER INCORRECT: 3 where 2 was due"));
  EXPECT_EQ(refused.alarm_line, 3u);
  EXPECT_THAT(moves_of({"LBL 1", "L IX+1 R0 F MAX", "CALL LBL 1 REP 1/1", "L X+9 F MAX"}, strict),
              ElementsAre("R X1", "R X2", "R X9"));
  EXPECT_THAT(
      run_text("%3 G71 *\nN1 G17 G40 G90 G00 X+1 *\nN7 X+2 *\nN9999 %3 G71 *\n", strict).events,
      ElementsAre("R X1", "R X2", testing::StartsWith("end")));
}

// HD-230: the restrictions of blockwise transfer, as an option.
TEST(TncFlow, BlockwiseTransferMayRefuseJumps) {
  const PathSetup restricted{"[control]\nblockwise_restrictions = true", {}};
  for (const char* block :
       {"CALL LBL 1 REP", "CALL LBL 1 REP 2/2", "CALL PGM 7", "FN 9: IF +0 EQU +0 GOTO LBL 1"}) {
    EXPECT_EQ(moves_of({"LBL 1", block}, restricted).back(),
              "! NOT PERMITTED IN BLOCKWISE TRANSFER");
  }
}

}  // namespace
}  // namespace dripline::interpreter
