#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/unit/gateway/interpreter/dialects/tnc155/path_run.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

const std::string kProgram =
    "0 BEGIN PGM 5 MM\n1 L X+1 Y+1 R0 F100\n2 L IX+1\n3 L X+3 Y+3\n4 L Y+9\n5 END PGM 5 MM\n";

PathRun from_block(int block, const std::string& text = kProgram) {
  return run_text(text, {"[control]\nstart_block = " + std::to_string(block), {}});
}

// HD-063, HD-193, HD-194, HD-228: GOTO before the start; the first block must say where it goes.
TEST(TncRun, BeginsAtABlock) {
  EXPECT_THAT(
      from_block(3, "0 BEGIN PGM 5 MM\n3 L X+3 Y+3 R0 F100\n4 L Y+9\n5 END PGM 5 MM\n").events,
      ElementsAre("stop", "L X3 Y3 F100", "L X3 Y9 F100", "end 4"));
  EXPECT_EQ(from_block(2).alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(from_block(4).alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(from_block(77).alarm_id, "TNC-NOT-ADDRESSED");
  EXPECT_EQ(from_block(2,
                       "0 BEGIN PGM 5 MM\n1 CYCL DEF 9.0 DWELL TIME\n2 CYCL DEF 9.1 DWELL 2\n"
                       "3 END PGM 5 MM\n")
                .alarm_id,
            "TNC-START-UNDEFINED");
}

// HD-194: M91 and arcs are positioning blocks as well.
TEST(TncRun, MachineCoordinatesAreACompleteStartToo) {
  const auto first = [](const std::string& block) {
    return from_block(2, "0 BEGIN PGM 5 MM\n1 CC X+0 Y+0\n2 " + block + "\n3 END PGM 5 MM\n");
  };
  EXPECT_EQ(first("L X+7 R0 F100 M91").alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(first("L IX+7 IY+1 R0 F100 M91").alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(first("L X+7 Y+1 R0 F100 M91").alarm_id, "");
}

// HD-194: also where the run begins at its beginning.
TEST(TncRun, BeginsWithAnAbsolutePosition) {
  const auto with = [](const std::string& rule, const std::vector<std::string>& blocks) {
    return run_blocks(blocks, {"[control]\nprogram_start = \"" + rule + "\"", {}, "MM"});
  };
  const std::vector<std::string> incremental{"L R F M", "L IX+10 IY+5 R0 F100", "L IX+1"};
  const PathRun refused = with("absolute", incremental);
  EXPECT_EQ(refused.alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(refused.alarm_line, 3u);
  EXPECT_THAT(refused.events, ElementsAre("! PROGRAM START UNDEFINED: the first positioning block "
                                          "is incremental"));
  EXPECT_THAT(with("any", incremental).events,
              ElementsAre("L X10 Y5 F100", "L X11 Y5 F100", "end 5"));
  EXPECT_EQ(with("absolute", {"IX+10 R0 F100"}).alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(with("absolute", {"L IX+7 R0 F100 M91"}).alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(with("absolute", {"CC X-10 Y+0", "CP IPA+90 DR+ R0 F100"}).alarm_id,
            "TNC-START-UNDEFINED");
  EXPECT_EQ(with("absolute", {"L X+10 R0 F100", "L IX+1"}).alarm_id, "");
  EXPECT_EQ(with("complete", {"L X+10 R0 F100"}).alarm_id, "TNC-START-UNDEFINED");
  EXPECT_EQ(with("complete", {"L X+10 Y+1 R0 F100", "L IX+1"}).alarm_id, "");
}

// HD-194: unless a setup says something else.
TEST(TncRun, AnAbsoluteBeginningIsTheDefault) {
  MemorySource source("0 BEGIN PGM 5 MM\n1 L IX+1 R0 F100\n2 END PGM 5 MM\n");
  EventSink sink;
  auto interpreter = *(*find_dialect("tnc155"))->make({}, source, sink);
  EXPECT_EQ(interpreter->step(9), StepState::Alarmed);
}

// HD-063: also after other blocks of its line.
TEST(TncRun, BeginsAtABlockWithinALine) {
  EXPECT_THAT(from_block(40,
                         "%5 G71 *\nN10 G17 G00 G40 G90 X+1 *\nN20 X+5 * N30 X+6 * N40 G17 G00 G40 "
                         "G90 X+8 Y+1 *\nN9999 %5 G71 *\n")
                  .events,
              ElementsAre("stop", "R X8 Y1", testing::StartsWith("end")));
}

// HD-058, HD-063: the units are those of the block that GOTO leads past.
TEST(TncRun, BeginsAtABlockInTheUnitsOfTheProgram) {
  EXPECT_THAT(from_block(2,
                         "0 BEGIN PGM 5 INCH\n1 L X+1 Y+1 R0 F100\n2 L X+3 Y+3 R0 F100\n"
                         "3 END PGM 5 INCH\n")
                  .events,
              ElementsAre("stop", "L X76.2 Y76.2 F254", testing::StartsWith("end")));
  EXPECT_THAT(from_block(20,
                         "%5 G70 *\nN10 G17 G00 G40 G90 X+1 Y+1 *\nN20 G17 G00 G40 G90 X+3 "
                         "Y+3 *\nN9999 %5 G70 *\n")
                  .events,
              ElementsAre("stop", "R X76.2 Y76.2", testing::StartsWith("end")));
}

// HD-194: a block that moves nothing has no coordinates to be complete.
TEST(TncRun, ABlockWithoutCoordinatesMayComeFirst) {
  EXPECT_THAT(from_block(2,
                         "0 BEGIN PGM 5 MM\n1 L X+1 Y+1 R0 F100\n2 L R F M08\n3 L X+3 Y+3 F50\n"
                         "4 END PGM 5 MM\n")
                  .events,
              ElementsAre("stop", "coolant on", "L X3 Y3 F50", "end 5"));
}

// HD-190: one block a step, whatever it is.
TEST(TncRun, StepsBlockByBlock) {
  MemorySource source(kProgram);
  EventSink sink;
  auto interpreter = (*find_dialect("tnc155"))->make({}, source, sink);
  ASSERT_TRUE(interpreter);
  for (std::uint64_t block = 1; block <= 5; ++block) {
    EXPECT_EQ((*interpreter)->step(1), StepState::Ran);
    EXPECT_EQ((*interpreter)->blocks(), block);
    EXPECT_EQ((*interpreter)->origin().sequence, static_cast<std::int64_t>(block - 1));
  }
  EXPECT_EQ((*interpreter)->step(1), StepState::Ended);
}

/// The moves of each step, and the block of each.
class StepSink final : public EventSink {
 public:
  void on_rapid(const Rapid& move) override { note(move.origin); }
  void on_line(const Line& move) override { note(move.origin); }
  void on_arc(const Arc& move) override { note(move.origin); }
  std::vector<std::int64_t> take() { return std::exchange(moves_, {}); }

 private:
  void note(const Origin& origin) { moves_.push_back(origin.sequence); }
  std::vector<std::int64_t> moves_;
};

// HD-190: a call of a cycle is one step; CC, LBL, definitions and RND are steps of their own, in
// which nothing moves.
TEST(TncRun, StepsTakeACycleAsOne) {
  const std::string text =
      "0 BEGIN PGM 5 MM\n1 TOOL DEF 1 L+0 R+2\n2 TOOL CALL 1 Z S 100\n3 CYCL DEF 1.0 PECKING\n"
      "4 CYCL DEF 1.1 SET-UP -2\n5 CYCL DEF 1.2 DEPTH -9\n6 CYCL DEF 1.3 PECKG -5\n"
      "7 CYCL DEF 1.4 DWELL 0\n8 CYCL DEF 1.5 F80\n9 LBL 1\n10 CC X+0 Y+0\n"
      "11 L X+3 Y+3 R0 F100 M03\n12 CYCL CALL M\n13 L X+20 Y+3\n14 RND R2\n15 L X+20 Y+30\n"
      "16 END PGM 5 MM\n";
  MemorySource source(text);
  StepSink sink;
  auto interpreter = (*find_dialect("tnc155"))->make({}, source, sink);
  ASSERT_TRUE(interpreter);
  std::map<std::int64_t, std::vector<std::int64_t>> moves;
  for (std::uint64_t step = 1; step <= 16; ++step) {
    ASSERT_EQ((*interpreter)->step(1), StepState::Ran);
    EXPECT_EQ((*interpreter)->blocks(), step);
    moves[(*interpreter)->origin().sequence] = sink.take();
  }
  EXPECT_EQ((*interpreter)->step(1), StepState::Ended);
  EXPECT_EQ(moves.size(), 16u);
  for (const auto& [block, made] : moves) {
    if (block < 11) {
      EXPECT_THAT(made, ElementsAre()) << block;
    }
  }
  EXPECT_THAT(moves[11], ElementsAre(11));
  EXPECT_THAT(moves[12], testing::AllOf(testing::SizeIs(testing::Gt(4u)), testing::Each(12)));
  EXPECT_THAT(moves[14], ElementsAre());
}

// HD-192: what a stop leaves, a later run of the same state finds: repeats and returns included.
TEST(TncRun, ASnapshotKeepsRepeatsAndReturns) {
  const std::string text =
      "0 BEGIN PGM 5 MM\n1 LBL 1\n2 CALL LBL 2 REP\n3 CALL LBL 1 REP 2/2\n4 STOP M02\n"
      "5 LBL 2\n6 L IX+1 R0 F MAX\n7 LBL 0\n8 END PGM 5 MM\n";
  MemorySource source(text);
  EventSink sink;
  const Dialect& dialect = **find_dialect("tnc155");
  const auto setup = parse_setup("[control]\nprogram_start = \"any\"\n");
  auto first = *dialect.make(*setup, source, sink);
  first->step(9);  // within the second pass
  auto second = *dialect.make(*setup, source, sink);
  ASSERT_TRUE(second->restore(first->snapshot()));
  while (first->step(1) == StepState::Ran) {
    second->step(1);
    EXPECT_EQ(first->snapshot().digest(), second->snapshot().digest());
  }
  EXPECT_EQ(second->step(1), StepState::Ended);
}

// HD-027, HD-097: the same contour in ISO.
TEST(TncRun, RunsIso) {
  EXPECT_THAT(run_text("%5 G71 *\nN10 G99 T1 L+0 R+5 *\nN20 T1 G17 S100 *\n"
                       "N30 G00 G40 G90 X+0 Y-20 *\nN40 G01 G42 X+0 Y+0 F100 *\nN50 X+40 *\n"
                       "N60 Y+30 *\nN70 G40 X+60 *\nN9999 %5 G71 *\n")
                  .events,
              ElementsAre("T1 L0 R5", "R X0 Y-20", "L X0 Y-5 F100", "L X40 Y-5 F100",
                          "A X45 Y0 c40,0 ccw90 F100", "L X45 Y30 F100", "L X60 Y30 F100",
                          testing::StartsWith("end")));
}

// HD-182: the plane in the block of G73 is that of its spindle axis: G17 rotates X to Y, G19 Y to
// Z.
TEST(TncRun, RotatesInThePlaneThatTheBlockNames) {
  const auto turned = [](const std::string& rotation) {
    return run_text("%5 G71 *\nN20 T0 G17 S100 *\nN30 G00 G40 G90 X+0 Y+0 *\nN40 " + rotation +
                    " *\nN50 X+10 Y+5 *\nN9999 %5 G71 *\n")
        .events[1];
  };
  EXPECT_EQ(turned("G73 G17 H+90"), "R X-5 Y10");
  EXPECT_EQ(turned("G73 H+90"), "R X-5 Y10");
  EXPECT_EQ(turned("G73 G19 H+90"), "R X10 Y0 Z5");
  EXPECT_EQ(turned("G73 G18 H+90"), "R X0 Y5 Z-10");
}

// HD-105, HD-032: G25 in the block of the corner, and in a block of its own.
TEST(TncRun, RoundsInIso) {
  for (const char* corner : {"N40 X+40 Y+0 G25 R5 *\n", "N40 X+40 Y+0 *\nN45 G25 R5 *\n"}) {
    EXPECT_THAT(run_text(std::string("%5 G71 *\nN20 T0 G17 S100 *\n"
                                     "N30 G01 G40 G90 X+0 Y+0 F100 *\n") +
                         corner + "N60 X+40 Y+30 *\nN9999 %5 G71 *\n")
                    .events,
                ElementsAre("T0 L0 R0", "L X35 Y0 F100", "A X40 Y5 c35,5 ccw90 F100",
                            "L X40 Y30 F100", testing::StartsWith("end")));
  }
}

// HD-189: the sub-blocks of a definition stand one after the other, of a datum shift as well.
TEST(TncRun, ADefinitionIsNotParted) {
  const std::vector<std::string> whole = {"CYCL DEF 7.0 DATUM SHIFT", "CYCL DEF 7.1 X+10",
                                          "CYCL DEF 7.2 Y+5", "L X+0 Y+0 R0 F100"};
  EXPECT_EQ(moves_of(whole).back(), "L X10 Y5 F100");
  std::vector<std::string> parted = whole;
  parted.insert(parted.begin() + 2, "L X+0 Y+0 R0 F100");
  EXPECT_EQ(moves_of(parted).back(), "! CYCL INCOMPLETE");
}

}  // namespace
}  // namespace dripline::interpreter
