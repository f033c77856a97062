// The text that a machine's axes get for a program with lengths of tools: interpreter, filter and
// queue as a gateway has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/machine/capability_filter.hpp"
#include "gateway/machine/streamed/motion_queue.hpp"

namespace dripline::machine::streamed {
namespace {

using interpreter::Dialect;
using interpreter::StepState;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Lines = std::vector<std::string>;

constexpr const char* kTools =
    "[[tool]]\nnumber = 1\nlength = 50.0\n[[tool]]\nnumber = 2\nlength = 80.0\nradius = 4.0\n";

class NoCommands final : public CommandWriter {
 public:
  std::optional<Refusal> tool(const interpreter::ToolChange&, Lines&) override { return {}; }
  std::optional<Refusal> miscellaneous(const interpreter::Miscellaneous&, Lines&) override {
    return {};
  }
  std::optional<Refusal> pin(const interpreter::PinChange&, Lines&) override { return {}; }
};

TextRules rules() {
  TextRules rules;
  for (std::size_t i = 0; i < 3; ++i) {
    rules.axes[i] = TextRules::AxisRules{};
    rules.axes[i]->travel = TextRules::Range{-500, 500};
  }
  return rules;
}

/// What the device gets, and the alarm that ends it.
class Written {
 public:
  Written(const Dialect& dialect, const std::string& text, const std::string& setup = kTools)
      : source_(text), builder_(std::make_unique<NoCommands>()) {
    builder_.begin(rules(), {});
    capabilities_.arcs = capabilities_.probing = capabilities_.tool_lengths = true;
    capabilities_.adds_lengths = true;
    CapabilityFilter filter(
        capabilities_, builder_,
        [this] {
          return CapabilityFilter::Now{interpreter_->modes(), interpreter_->origin().block};
        },
        {dialect.length_shifts_position, dialect.moves_with_length,
         [this](const ToolLengths& lengths) { builder_.set_lengths(lengths); }});
    filter.begin({}, {});
    auto made = dialect.make(interpreter::parse_setup(setup).value(), source_, filter);
    EXPECT_TRUE(made) << made.error().what;
    interpreter_ = *std::move(made);
    while (interpreter_->step(1) == StepState::Ran)
      if (!filter.note_block(interpreter_->origin())) break;
    for (const Action& action : builder_.take()) {
      if (const auto* motion = std::get_if<Motion>(&action.body))
        for (const std::string& line : motion->lines) lines.push_back(line);
      if (const auto* end = std::get_if<AlarmEvent>(&action.body))
        alarm = end->diagnostic.id.data() + (": " + end->diagnostic.text);
      last = action.lengths;
    }
  }
  std::vector<std::string> lines;
  std::string alarm;
  ToolLengths last{};  ///< of the last action

 private:
  interpreter::MemorySource source_;
  QueueBuilder builder_;
  MotionCapabilities capabilities_;
  std::unique_ptr<interpreter::Interpreter> interpreter_;
};

// -- RS274/NGC: the position is shifted, and no axis moves (NGC-039) ----------------------------

TEST(LengthTextOfNgc, IsAddedToEveryMoveOfTheAxis) {
  const Written it(interpreter::kRs274NgcDialect,
                   "G21 F600\nG0 Z20\nG43 H1\nX5\nZ10\nG1 Z-3\nG49\nX0\nG0 Z100\nM2\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_EQ(it.lines, (Lines{"G0Z20", "G0X5", "G0Z60", "G1Z47F600", "G1X0", "G0Z100"}));
}

TEST(LengthTextOfNgc, IsInBothEndsOfAHelixAndItsCenterInThePlaneOfTheLength) {
  const Written it(interpreter::kRs274NgcDialect,
                   "G21 F600\nG43 H1\nG1 X10 Z0\nG2 X-10 I-10 J0 Z-5\nG18 G2 X0 Z-15 I10 K0\nM2\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G1X10Z50F600", "G17G2X-10Z45Y0I-10J0", "G18G2X0Z35K0I10"));
}

TEST(LengthTextOfNgc, IsLeftOutOfMachineCoordinates) {
  const Written it(interpreter::kRs274NgcDialect,
                   "G21\nG43 H1\nG0 Z10\nG53 G0 Z200\nG28 Z5\nG0 Z10\nM2\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0Z60", "G0Z200", "G0Z55", "G0Z0", "G0Z60"))
      << "G28: by Z5 of the program to the axis' own zero";
}

TEST(LengthTextOfNgc, HasTheCyclesOfATool) {
  const Written it(interpreter::kRs274NgcDialect,
                   "G21 F100\nG43 H2\nG0 Z20\nG98 G81 X5 Y5 Z-4 R2\nX8\nG80\nM2\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0Z100", "G0X5Y5", "G0Z82", "G1Z76F100", "G0Z100", "G0X8",
                                    "G0Z82", "G1Z76", "G0Z100"));
}

// The tip is inside the travel, the axis is not.
TEST(LengthTextOfNgc, IsInTheTravel) {
  const Written it(interpreter::kRs274NgcDialect, "G21\nG43 H1\nG0 Z449\nZ451\nM2\n");
  EXPECT_THAT(it.lines, ElementsAre("G0Z499"));
  EXPECT_THAT(it.alarm, AllOf(HasSubstr("MCH0001"), HasSubstr("Z 501")));
}

TEST(LengthTextOfNgc, OfAnotherAxisIsRefused) {
  const std::string setup = "[control]\nprofile = \"linuxcnc\"\naxes = \"XYZABCUVW\"\n";
  const Written it(interpreter::kRs274NgcDialect, "G21\nG43.1 W5\nG0 X1\nM2\n", setup);
  EXPECT_THAT(it.lines, IsEmpty());
  EXPECT_THAT(
      it.alarm,
      HasSubstr("MCH0008: this machine cannot take the length of a tool into account that"));
}

TEST(LengthTextOfNgc, IsKnownToABlockWithoutAMove) {
  const Written it(interpreter::kRs274NgcDialect, "G21\nG43 H1\n(x)\nM0\n");
  EXPECT_EQ(it.last, (ToolLengths{0, 0, 50}));
}

// A datum and a rotation come before the length.
TEST(LengthTextOfNgc, LiesAlongTheMachinesAxes) {
  const Written it(interpreter::kRs274NgcDialect,
                   "G21 G10 L2 P1 X100 Z-30 R90\nG54\nG43.1 X7 Z50\nG0 X10 Y0 Z5\nM2\n",
                   "[control]\nprofile = \"linuxcnc\"\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0X107Y10Z25"));
}

// -- Fanuc: the position stays, and an axis follows with its own next move (FAN-034) -------------

constexpr const char* kBegin = "O1\nG21 G90 G94 G17 F600\n";

Written fanuc(const std::string& text) {
  return {interpreter::kFanucDialect, kBegin + text + "M30\n"};
}

TEST(LengthTextOfFanuc, IsTakenInByTheMoveOfItsAxis) {
  const Written it = fanuc("G0 Z20.\nG43 H1 Z30.\nX5.\nG1 Z-3.\nG44 H1 Z0\nG49 Z100.\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0Z20", "G0Z80", "G0X5", "G1Z47F600", "G1Z-50", "G1Z100"));
}

// G43 alone in a block moves the axis by the length, or not, by a parameter.
TEST(LengthTextOfFanuc, IsAnAlarmWhereItsAxisIsNotMovedFirst) {
  for (const std::string move : {"X5.", "X5. Z20.", "G2 X5. Y5. I5."}) {
    const Written it = fanuc("G0 Z20.\nG43 H1\n" + move + "\n");
    EXPECT_THAT(it.lines, ElementsAre("G0Z20")) << move;
    EXPECT_THAT(it.alarm, AllOf(HasSubstr("MCH0008"), HasSubstr("Z is 50.000 mm and was 0.000")))
        << move;
  }
  EXPECT_THAT(fanuc("G0 X3. Y4. Z20.\nG43 H1 G2 X5. Y6. Z10. I2.\n").alarm, HasSubstr("arc"));
}

TEST(LengthTextOfFanuc, IsLeftOutAtTheReferencePointAndInMachineCoordinates) {
  const Written it =
      fanuc("G43 H1 Z30.\nG91 G28 Z0\nG90 X40.\nG43 H2 Z2.\nG53 Z300.\nX0\nZ2.\nG28 Z5.\nX1.\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0Z80", "G0Z0", "G0X40", "G0Z82", "G0Z300", "G0X0", "G0Z82",
                                    "G0Z85", "G0Z0", "G0X1"));
}

// Z0 of the program is another place for the axis than the reference point Z0.
TEST(LengthTextOfFanuc, IsMissedByAMoveThatSeemsToBeNone) {
  const Written it = fanuc("G43 H1 Z30.\nG28 Z30.\nZ0\nX40.\n");
  EXPECT_THAT(it.lines, ElementsAre("G0Z80", "G0Z0"));
  EXPECT_THAT(it.alarm, HasSubstr("MCH0008"));
}

// What present position does G92 name: that of the axis, or that of the tip?
TEST(LengthTextOfFanuc, IsInDoubtWhereCoordinatesAreSetWithoutIt) {
  for (const std::string before : {"G43 H1 Z30.\nG28 Z30.\n", "G0 Z30.\nG43 H1\n"}) {
    const Written it = fanuc(before + "G92 Z0\nG0 Z7.\n");
    EXPECT_THAT(it.alarm, HasSubstr("in doubt")) << before;
  }
  const Written it = fanuc("G43 H1 Z30.\nG92 Z0\nZ7.\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0Z80", "G0Z87"));
}

TEST(LengthTextOfFanuc, IsInDoubtAtTheReferencePointInCompensation) {
  const Written it = fanuc("G43 H1 Z30.\nG1 G41 D2 X10. Y5.\nX30.\nG28 Z40.\nX50.\nG40 X60.\n");
  EXPECT_THAT(it.alarm, HasSubstr("in doubt"));
}

TEST(LengthTextOfFanuc, OfAMoveThatCompensationHoldsBackIsTheOneOfItsBlock) {
  const Written held =
      fanuc("G43 H1 Z30.\nG1 G41 D2 X10. Y5.\nX30.\nZ-8.\nG49 Z9.\nX50.\nG40 X60.\n");
  EXPECT_THAT(held.alarm, HasSubstr("after the length of the tool has changed"));
  const Written plain = fanuc("G43 H1 Z30.\nG1 G41 D2 X10. Y5.\nX30.\nZ-8.\nX50.\nG40 X60.\n");
  EXPECT_EQ(plain.alarm, "");
  EXPECT_THAT(plain.lines, testing::Contains("G1Z42"));
}

TEST(LengthTextOfFanuc, IsInTheHolesOfACycle) {
  const Written it = fanuc("G0 Z99.\nG43 H1\nG81 X5. Z-4. R2.\nX8.\nG80\n");
  EXPECT_THAT(it.alarm, HasSubstr("MCH0008")) << "the cycle begins with X";
  const Written named = fanuc("G43 H1 Z20.\nG81 X5. Z-4. R2.\nG80\n");
  EXPECT_EQ(named.alarm, "");
  EXPECT_THAT(named.lines, ElementsAre("G0Z70", "G0X5", "G0Z52", "G1Z46F600", "G0Z70"));
}

// HD-129
Written tnc(const std::string& blocks, const Dialect& dialect = interpreter::kTnc155Dialect) {
  std::string text = "0 BEGIN PGM 1 MM\n";
  int number = 1;
  for (std::size_t at = 0, end; (end = blocks.find('\n', at)) != std::string::npos; at = end + 1)
    text += fmt::format("{} {}\n", number++, blocks.substr(at, end - at));
  return {dialect, text + fmt::format("{} END PGM 1 MM\n", number), ""};
}

constexpr const char* kCall = "TOOL DEF 1 L+50 R+5\nTOOL DEF 2 L-7.5 R+5\nTOOL CALL 1 Z S2000\n";

TEST(LengthTextOfTnc, IsTakenInByTheMoveOfTheToolAxis) {
  const Written it = tnc(std::string(kCall) +
                         "L X+0 Y+0 Z+20 R0 FMAX\nL X+5 FMAX\nL Z-3 F600\nCC X+5 Y+10\nCP IPA+180 "
                         "IZ-4 DR+\nTOOL CALL 2 Z\nL Z+30 FMAX\nTOOL CALL 0 Z\nL Z+100 FMAX\n");
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines,
              ElementsAre("G0Z70", "G0X5", "G1Z47F600", "G17G3Y20Z43X5I0J10", "G0Z22.5", "G0Z100"));
}

TEST(LengthTextOfTnc, IsAnAlarmWhereItsAxisIsNotMovedFirst) {
  EXPECT_THAT(tnc(std::string(kCall) + "L X+5 Y+6 R0 FMAX\n").alarm,
              HasSubstr("Z is 50.000 mm and was 0.000"));
}

TEST(LengthTextOfTnc, IsInDoubtInMachineCoordinatesOfItsAxis) {
  for (const Dialect* dialect : {&interpreter::kTnc155Dialect, &interpreter::kItncDialect}) {
    const std::string begin = std::string(kCall) + "L X+1 Y+0 Z+20 R0 FMAX\n";
    EXPECT_THAT(tnc(begin + "L Z+90 R0 FMAX M91\n", *dialect).alarm, HasSubstr("in doubt"));
    EXPECT_EQ(tnc(begin + "L X+90 R0 FMAX M91\n", *dialect).alarm, "");
    const Written none = tnc(begin + "TOOL CALL 0 Z\nL Z+90 R0 FMAX M91\n", *dialect);
    EXPECT_EQ(none.alarm, "");
    EXPECT_THAT(none.lines, testing::Contains("G0Z90"));
  }
}

// Its lengths in machine coordinates are not decided by a manual.
TEST(LengthTextOfACenturion, IsAnAlarm) {
  const Written it(interpreter::kCenturionDialect, "O1\nG21 G98\nT0303 M6\nG0 X60. Z2.\nM30\n",
                   "units = \"mm\"\n[[tool]]\nnumber = 3\nX = 10.0\n");
  EXPECT_THAT(it.lines, IsEmpty());
  EXPECT_THAT(it.alarm, AllOf(HasSubstr("MCH0008"), HasSubstr("with this control: X 10.000")));
}

TEST(LengthTextOfALathe, IsTakenInByBothAxes) {
  const std::string tools = "[[tool]]\nnumber = 3\nX = 10.0\nZ = -20.0\n";
  const Written it(
      interpreter::kFanucLatheDialect,
      "O1\nG21 G98 F600\nG0 X40. Z5.\nT0303\nG0 X60. Z2.\nG1 Z-8.\nT0300 X90. Z50.\nM30\n", tools);
  EXPECT_EQ(it.alarm, "");
  EXPECT_THAT(it.lines, ElementsAre("G0X20Z5", "G0X40Z-18", "G1Z-28F600", "G1X45Z50"));
  const Written one(interpreter::kFanucLatheDialect,
                    "O1\nG21 G98 F600\nG0 X40. Z5.\nT0303\nG0 X60.\nM30\n", tools);
  EXPECT_THAT(one.alarm, HasSubstr("Z is -20.000 mm and was 0.000"));
}

}  // namespace
}  // namespace dripline::machine::streamed
