#include <gtest/gtest.h>

#include "gateway/machine/grbl/board_info.hpp"
#include "gateway/machine/grbl/command_writer.hpp"
#include "gateway/machine/streamed/motion_writer.hpp"

/// What a board reads, by what it states about itself.
namespace dripline::machine::grbl {
namespace {

using interpreter::Axis;
using interpreter::Plane;
using interpreter::Position;
using interpreter::Turn;
using streamed::MotionText;
using streamed::MotionWriter;
using streamed::Refusal;
using Lines = std::vector<std::string>;

BoardInfo board_of(double steps = 1000, std::size_t axes = 3) {
  BoardInfo board;
  board.take(Greeting{"1.1f", false});
  board.take(BuildReply{"VN", 15, 128});
  for (std::size_t i = 0; i < axes; ++i) {
    const int n = static_cast<int>(i);
    board.take(SettingReply{100 + n, steps});
    board.take(SettingReply{110 + n, 6000});
    board.take(SettingReply{120 + n, 500});
    board.take(SettingReply{130 + n, 200});
  }
  board.take(SettingReply{10, 1});
  for (const int number : {13, 20, 22}) board.take(SettingReply{number, 0});
  board.take(SettingReply{30, 5000});
  board.take(OffsetReply{"G54", {{1, 0, 0}, 3}});
  board.take(OffsetReply{"G55", {{0, 0, 0}, 3}});
  return board;
}

Position point(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}

class BoardText : public testing::Test {
 protected:
  void make(const BoardInfo& board) {
    streamed::TextRules rules = board.rules();
    rules.seconds_ahead.reset();  // every move in one piece
    writer = MotionWriter(rules);
    writer.begin({});
    commands.begin(rules);
  }
  BoardText() { make(board_of()); }
  Lines rapid(double x, double y, double z) {
    text = {};
    refusal = writer.rapid({{}, point(x, y, z)}, text);
    return text.lines;
  }
  Lines line(double x, double y, double z, Feed feed, bool rests = false) {
    text = {};
    refusal = writer.line({{}, point(x, y, z), feed, rests}, text);
    return text.lines;
  }
  Lines line(double x, double y, double z, double feed) {
    return line(x, y, z, Feed::per_minute(Length::mm(feed)));
  }
  Lines arc(double x, double y, double z, double i, double j, double sweep,
            Turn turn = Turn::Counterclockwise, Plane plane = Plane::XY) {
    text = {};
    refusal = writer.arc({.origin = {},
                          .to = point(x, y, z),
                          .center_first = Length::mm(i),
                          .center_second = Length::mm(j),
                          .plane = plane,
                          .turn = turn,
                          .sweep = Angle::degrees(sweep),
                          .feed = Feed::per_minute(Length::mm(600))},
                         text);
    return text.lines;
  }
  MotionWriter writer{streamed::TextRules{}};
  BoardCommands commands;
  MotionText text;
  std::optional<Refusal> refusal;
};

TEST_F(BoardText, WritesWhatChanges) {
  EXPECT_EQ(rapid(1, 0, -2.5), Lines{"G0X1Z-2.5"});
  EXPECT_EQ(line(1, 3, -2.5, 300), Lines{"G1Y3F300"});
  EXPECT_EQ(line(1.25, 3, -2.5, 300), Lines{"G1X1.25"}) << "the feed is in force";
  EXPECT_EQ(line(2, 3, -2.5, 250.5), Lines{"G1X2F250.5"});
  EXPECT_NEAR(text.seconds, 0.75 / 250.5 * 60, 1e-9);
}

TEST_F(BoardText, HasTheDecimalsOfTheBoardsSteps) {
  EXPECT_EQ(rapid(0.12344, 0, 0), Lines{"G0X0.1234"});
  make(board_of(80));
  EXPECT_EQ(rapid(0.12344, 0, 0), Lines{"G0X0.123"});
}

TEST_F(BoardText, WritesNoLineForLessThanAStepAndLosesNothing) {
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(line(i * 0.0001, 0, 0, 300), Lines{});
  EXPECT_EQ(line(0.0006, 0, 0, 300), Lines{"G1X0.0006F300"});
}

TEST_F(BoardText, LetsTheAxesRestByADwellOfNoTime) {
  EXPECT_EQ(line(1, 0, 0, Feed::per_minute(Length::mm(100)), true), (Lines{"G1X1F100", "G4P0"}));
}

TEST_F(BoardText, TurnsInverseTimeIntoFeedPerMinute) {
  EXPECT_EQ(line(30, 40, 0, Feed::inverse_time(4)), Lines{"G1X30Y40F200"});
}

TEST_F(BoardText, NamesAxesAsTheBoardDoes) {
  BoardInfo board = board_of(1000, 5);
  board.take(AxesReply{"XYZBU"});
  ASSERT_TRUE(board.check());
  const auto at = board.in_mm({{1, 2, 3, 4, 5}, 5});
  EXPECT_EQ(at, (streamed::Coordinates{1, 2, 3, 0, 4, 0, 5}));
  make(board);
  Position to = point(0, 0, 0);
  to.set(Axis::B, Angle::degrees(30));
  to.set(Axis::U, Length::mm(2));
  EXPECT_FALSE(writer.rapid({{}, to}, text));
  EXPECT_EQ(text.lines, Lines{"G0B30U2"});
  to.set(Axis::A, Angle::degrees(1));
  EXPECT_TRUE(writer.rapid({{}, to}, text)) << "it has no A";
}

// What a board makes of a feed then depends on its version and a setting: 3 mm or 5 units.
TEST_F(BoardText, TimesMovesOfLinearAndRotaryAxesTogether) {
  make(board_of(1000, 4));
  Position to = point(3, 0, 0);
  to.set(Axis::A, Angle::degrees(4));
  refusal = writer.line({{}, to, Feed::per_minute(Length::mm(300))}, text);
  EXPECT_EQ(text.lines, Lines{"G1X3A4G93F100"}) << "0.01 minutes";
  EXPECT_NEAR(text.seconds, 0.6, 1e-9);
  EXPECT_EQ(rapid(4, 0, 0), Lines{"G0X4"});
  EXPECT_EQ(line(5, 0, 0, 300), Lines{"G1X5G94F300"});
  to.set(Axis::X, Length::mm(5));
  to.set(Axis::A, Angle::degrees(8));
  text = {};
  refusal = writer.line({{}, to, Feed::per_minute(Length::mm(300))}, text);
  EXPECT_EQ(text.lines, Lines{"G1A8"}) << "of the rotary axis alone: degrees per minute";
}

TEST_F(BoardText, TheFeedOfAnArcIsThatOfItsLinearAxes) {
  make(board_of(1000, 4));
  Position to = point(10, 10, 0);
  to.set(Axis::A, Angle::degrees(90));
  interpreter::Arc arc{.origin = {},
                       .to = to,
                       .center_first = Length::mm(0),
                       .center_second = Length::mm(10),
                       .turn = Turn::Counterclockwise,
                       .sweep = Angle::degrees(90),
                       .feed = Feed::per_minute(Length::mm(600))};
  text = {};
  refusal = writer.arc(arc, text);
  EXPECT_NEAR(text.seconds, 5 * Angle::kPi / 600 * 60, 1e-6);
  EXPECT_TRUE(text.lines.front().find("G93F") != std::string::npos) << text.lines.front();
}

TEST_F(BoardText, RefusesAFeedThatTheBoardWouldRaise) {
  EXPECT_EQ(line(1, 0, 0, 1), Lines{"G1X1F1"});
  EXPECT_EQ(line(2, 0, 0, 0.5), Lines{});
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->id, "MCH0003");
  EXPECT_EQ(refusal->text, "a feed of 0.5 mm/min, the machine's lowest is 1");
}

// Single precision puts the center of a large one beside its place, at worst so far that the board
// makes a whole circle of a short arc.
TEST_F(BoardText, WritesArcsOfALargeRadiusAsChords) {
  const double radius = 100'000, angle = 1e-5;
  const Lines lines =
      arc(radius * std::sin(angle), radius * (1 - std::cos(angle)), 0, 0, radius, 0.00057296);
  EXPECT_EQ(lines, (Lines{"G1X1F600"}));
  (void)rapid(0, 0, 0);
  EXPECT_EQ(arc(2000, 2000, 0, 0, 2000, 90).size(), 556U) << "within 0.002 mm";
  BoardInfo coarse = board_of();
  coarse.take(SettingReply{12, 0.5});
  make(coarse);
  EXPECT_EQ(arc(10, 10, 0, 0, 10, 90).size(), 40U) << "the board's would leave the arc by 0.5 mm";
}

/// As the firmware checks it: 5 µm, and a thousandth of the radius.
bool would_be_refused(const std::string& line, double x, double y) {
  const auto word = [&](char letter) { return std::stod(line.substr(line.find(letter) + 1)); };
  const double radius = std::hypot(word('I'), word('J'));
  const double end = std::hypot(word('X') - x - word('I'), word('Y') - y - word('J'));
  return std::fabs(end - radius) > 0.005 && std::fabs(end - radius) > 0.001 * radius;
}

TEST_F(BoardText, RoundingDoesNotMakeAnArcThatTheBoardRefuses) {
  make(board_of(80));  // three decimals
  int arcs = 0;
  for (int i = 0; i < 20'000; ++i) {
    // 3.9 µm between the radii, and every place between the digits.
    const double x = 5 + 0.00037 * (i % 101), y = 3 + 0.00011 * (i % 97),
                 angle = 0.1 + 0.0003 * (i % 4000);
    make(board_of(80));
    (void)rapid(x, y, 0);
    const Coordinates from{std::round(x * 1000) / 1000, std::round(y * 1000) / 1000};
    const double sign = i % 2 == 0 ? 1 : -1, radius = 1.2 + sign * 0.0039;
    const double cx = x + 1.2 * std::cos(0.7 * i), cy = y + 1.2 * std::sin(0.7 * i);
    const double at = std::atan2(y - cy, x - cx) + angle;
    for (const std::string& line : arc(cx + radius * std::cos(at), cy + radius * std::sin(at), 0,
                                       cx, cy, angle * 180 / Angle::kPi)) {
      if (line.find('I') == std::string::npos) continue;
      ++arcs;
      ASSERT_FALSE(would_be_refused(line, from[0], from[1])) << i << " " << line;
    }
  }
  EXPECT_EQ(arcs, 0) << "they are chords";
}

TEST_F(BoardText, WritesALongDwellInSeveral) {
  Lines lines;
  EXPECT_FALSE(writer.dwell(0.25, lines));
  EXPECT_EQ(lines, Lines{"G4P0.25"});
  lines.clear();
  EXPECT_FALSE(writer.dwell(7'000.5, lines));
  EXPECT_EQ(lines, (Lines{"G4P3000", "G4P3000", "G4P1000.5"})) << "more overflows its counter";
  lines.clear();
  EXPECT_FALSE(writer.dwell(0, lines));
  EXPECT_TRUE(lines.empty());
  EXPECT_TRUE(writer.dwell(1e300, lines));
}

TEST_F(BoardText, WritesArcsByTheirCenterInEveryPlane) {
  EXPECT_EQ(arc(10, 10, 0, 0, 10, 90), Lines{"G17G3X10Y10I0J10F600"});
  make(board_of());
  EXPECT_EQ(arc(10, 0, 10, 0, 10, 90, Turn::Counterclockwise, Plane::ZX),
            Lines{"G18G3X10Z10K0I10F600"});
  make(board_of());
  EXPECT_EQ(arc(0, 10, 10, 0, 10, 90, Turn::Counterclockwise, Plane::YZ),
            Lines{"G19G3Y10Z10J0K10F600"});
}

TEST_F(BoardText, SplitsWhatIsMoreThanHalfACircle) {
  (void)rapid(10, 0, 0);
  EXPECT_EQ(arc(10, 0, 0, 0, 0, 360, Turn::Clockwise),
            (Lines{"G17G2X-10Y0I-10J0F600", "G17G2X10Y0I10J0"}));
  EXPECT_EQ(arc(10, 0, 4, 0, 0, 720).size(), 4U) << "a helix of two revolutions";
  EXPECT_EQ(text.lines.back(), "G17G3X10Z4Y0I10J0");
}

TEST_F(BoardText, MakesNoCircleOfAnArcWithoutLength) {
  (void)rapid(10, 0, 0);
  EXPECT_EQ(arc(10, 0.0005, 0, 0, 0, 0.003), Lines{"G1Y0.0005F600"});
}

TEST_F(BoardText, WritesASpiralAsChords) {
  (void)rapid(10, 0, 0);
  const Lines lines = arc(0, 12, 0, 0, 0, 90);
  EXPECT_GT(lines.size(), 20U);
  for (const std::string& chord : lines) EXPECT_TRUE(chord.starts_with("G1X")) << chord;
  EXPECT_EQ(writer.at()[1], 12);
}

TEST_F(BoardText, RefusesWhatTheBoardCannotDo) {
  (void)line(1, 0, 0, Feed::per_revolution(Length::mm(0.1)));
  EXPECT_EQ(refusal->text, "this machine cannot feed per revolution");
  (void)line(1, 0, 0, 0);
  EXPECT_EQ(refusal->id, "MCH0003");
  Position to;
  to.set(Axis::B, Angle::degrees(4));
  refusal = writer.rapid({{}, to}, text);
  EXPECT_EQ(refusal->text, "the machine has no B axis");
  (void)rapid(std::nan(""), 0, 0);
  EXPECT_EQ(refusal->id, "MCH0006");
  Lines lines;
  refusal =
      commands.spindle({{}, interpreter::SpindleState::Clockwise, 0, Length::mm(100), {}}, lines);
  EXPECT_EQ(refusal->text, "this machine cannot keep a constant surface speed");
  BoardInfo one_way = board_of();
  one_way.take(BuildReply{"VND", 15, 128});
  make(one_way);
  refusal = commands.spindle({{}, interpreter::SpindleState::Counterclockwise, 100, {}, {}}, lines);
  ASSERT_TRUE(refusal) << "it would turn clockwise";
  EXPECT_EQ(refusal->text, "this machine cannot turn the spindle counterclockwise");
  refusal = commands.spindle({{}, interpreter::SpindleState::Clockwise, 6000, {}, {}}, lines);
  EXPECT_EQ(refusal->text, "spindle speed 6000 is above the machine's 5000 rpm ($30)");
  refusal = commands.coolant({{}, false, true}, lines);
  EXPECT_EQ(refusal->text, "this machine cannot switch mist coolant");
  refusal = commands.miscellaneous({{}, 25}, lines);
  EXPECT_EQ(refusal->text, "this machine cannot do M25");
  refusal = commands.pin({{}, {}, 2, true, {}}, lines);
  EXPECT_EQ(refusal->text, "this machine cannot switch output 2");
  EXPECT_TRUE(lines.empty());
}

TEST_F(BoardText, KeepsToTheTravelWhereSoftLimitsAreInForce) {
  EXPECT_EQ(rapid(500, 0, 0), Lines{"G0X500"}) << "no soft limits";
  BoardInfo board = board_of();
  board.take(SettingReply{20, 1});
  make(board);
  EXPECT_EQ(rapid(-200, 0, 0), Lines{"G0X-200"});
  (void)rapid(-200, 1, 0);
  EXPECT_EQ(refusal->text, "Y 1 mm is outside the machine's travel of -200 to 0 ($20, $23, $131)");
  (void)arc(-200, -100, 0, -200, -50, 180, Turn::Counterclockwise);
  EXPECT_TRUE(refusal) << "the arc bulges beyond the travel";
  (void)rapid(-100, -100, 0);
  EXPECT_EQ(arc(-100, -50, 0, -100, -75, 180), Lines{"G17G3Y-50X-100I0J25F600"});
  EXPECT_EQ(arc(-100, 0, 0, -100, -25, 180).front().substr(0, 3), "G1X")
      << "in single precision the arc would leave the travel";
  make(board);
  EXPECT_EQ(rapid(-200, 0.00004, 0), Lines{"G0X-200"}) << "rounded, it is at its limit";
  (void)rapid(0, 0.0001, 0);
  EXPECT_TRUE(refusal) << "the board is exact, and stops in the middle of the program";
}

TEST_F(BoardText, SwitchesSpindleAndCoolant) {
  Lines lines;
  EXPECT_FALSE(
      commands.spindle({{}, interpreter::SpindleState::Counterclockwise, 1200, {}, {}}, lines));
  EXPECT_EQ(lines, Lines{"M4S1200"});
  lines.clear();
  EXPECT_FALSE(commands.coolant({{}, true, false}, lines));
  EXPECT_EQ(lines, Lines{"M8"});
  lines.clear();
  EXPECT_FALSE(commands.coolant({{}, false, false}, lines));
  EXPECT_EQ(lines, Lines{"M9"});
}

TEST(BoardInfoTest, UsesAWorkOffsetThatIsZero) {
  EXPECT_EQ(board_of().work_system(), "G55");
}

TEST(BoardInfoTest, NeedsNoMoreLineNumbersThanTheBoardHoldsLines) {
  BoardInfo board = board_of();
  EXPECT_EQ(board.line_numbers(), 99U);
  board.take(BuildReply{"VN", 100, 1024});
  EXPECT_EQ(board.line_numbers(), 999U);
  board.take(BuildReply{"VN", 1'000'000'000, 1'000'000'000});
  EXPECT_EQ(board.line_numbers(), 99'999U);
  EXPECT_EQ(board.window(), 4096U) << "of a large buffer only a part is used";
}

TEST(BoardInfoTest, NamesWhatMakesABoardUnfit) {
  const auto reason = [](const BoardInfo& board) {
    const auto fit = board.check();
    return fit ? std::string() : fit.error().what;
  };
  EXPECT_EQ(reason(board_of()), "");
  BoardInfo board = board_of();
  board.take(Greeting{"0.9j", false});
  EXPECT_NE(reason(board).find("Grbl 0.9j"), std::string::npos);
  board = board_of();
  board.take(SettingReply{32, 1});
  EXPECT_NE(reason(board).find("laser mode"), std::string::npos);
  board = board_of();
  board.take(BuildReply{"V", 15, 128});
  EXPECT_NE(reason(board).find("set $10 to 3"), std::string::npos);
  board = board_of();
  board.take(OffsetReply{"G55", {{0, 0, 7}, 3}});
  EXPECT_NE(reason(board).find("none of the board's work offsets"), std::string::npos);
  EXPECT_EQ(reason([] {
              BoardInfo silent;
              silent.take(Greeting{"1.1f", false});
              silent.take(BuildReply{"VN", 15, 128});
              for (const int number : {100, 101}) silent.take(SettingReply{number, 80});
              return silent;
            }()),
            "the board does not state its setting $10");
  for (const char* letters : {"XYQ", "XYX"}) {
    board = board_of();
    board.take(AxesReply{letters});
    EXPECT_NE(reason(board).find("the board's axes are XY"), std::string::npos) << letters;
  }
  board = board_of();
  board.take(BuildReply{"VN", 15, 64});
  EXPECT_NE(reason(board).find("64 bytes"), std::string::npos);
}

}  // namespace
}  // namespace dripline::machine::grbl
