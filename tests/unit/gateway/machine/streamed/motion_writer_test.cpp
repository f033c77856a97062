#include "gateway/machine/streamed/motion_writer.hpp"

#include <gmock/gmock.h>

namespace dripline::machine::streamed {
namespace {

using interpreter::Axis;
using testing::ElementsAre;
using testing::IsEmpty;

TextRules three_axes() {
  TextRules rules;
  for (std::size_t i = 0; i < 3; ++i) {
    rules.axes[i] = TextRules::AxisRules{};
    rules.axes[i]->travel = TextRules::Range{-100, 100};
  }
  rules.decimals = 6;
  rules.has_stop_mode = true;
  return rules;
}

interpreter::Position point(std::initializer_list<std::pair<Axis, double>> values) {
  interpreter::Position position;
  for (const auto& [axis, value] : values) position.set_raw(axis, value);
  return position;
}

Feed feed(double mm) {
  return Feed::per_minute(Length::mm(mm));
}

struct Writer {
  explicit Writer(const TextRules& rules = three_axes()) : writer(rules) { writer.begin({}); }
  MotionText line(interpreter::Position to, Feed at, bool rests = false) {
    MotionText text;
    refusal = writer.line({.origin = {}, .to = to, .feed = at, .rests = rests}, text);
    return text;
  }
  MotionText rapid(interpreter::Position to, bool rests) {
    MotionText text;
    refusal = writer.rapid({.origin = {}, .to = to, .rests = rests}, text);
    return text;
  }
  MotionWriter writer;
  std::optional<Refusal> refusal;
};

TEST(MotionWriter, WritesWhatChangesOnly) {
  Writer it;
  EXPECT_THAT(it.line(point({{Axis::X, 1.25}, {Axis::Y, 0}}), feed(600)).lines,
              ElementsAre("G61G1X1.25F600"));
  EXPECT_THAT(it.line(point({{Axis::X, 1.25}, {Axis::Z, -1.0 / 3}}), feed(600)).lines,
              ElementsAre("G1Z-0.333333"));
  EXPECT_THAT(it.rapid(point({{Axis::X, 0}}), true).lines, ElementsAre("G61.1G0X0"));
  EXPECT_THAT(it.line(point({{Axis::X, 1}}), feed(300), true).lines, ElementsAre("G1X1F300"));
  EXPECT_THAT(it.line(point({{Axis::X, 2}}), feed(300)).lines, ElementsAre("G61G1X2"));
}

TEST(MotionWriter, LessThanAStepIsNoLineAndIsNotLost) {
  Writer it;
  EXPECT_THAT(it.line(point({{Axis::X, 0.0004}}), feed(600)).lines, IsEmpty());
  EXPECT_THAT(it.line(point({{Axis::X, 0.0008}}), feed(600)).lines,
              ElementsAre("G61G1X0.0008F600"));
}

TEST(MotionWriter, ADeviceWithoutStopModesDwells) {
  TextRules rules = three_axes();
  rules.has_stop_mode = false;
  Writer it(rules);
  EXPECT_THAT(it.line(point({{Axis::X, 1}}), feed(600), true).lines,
              ElementsAre("G1X1F600", "G4P0"));
}

TEST(MotionWriter, AFullCircleIsTwoHalves) {
  Writer it;
  MotionText text;
  interpreter::Arc arc{.origin = {},
                       .to = point({{Axis::X, 0}, {Axis::Y, 0}}),
                       .center_first = Length::mm(5),
                       .center_second = Length::mm(0),
                       .sweep = Angle::degrees(360),
                       .feed = feed(600)};
  EXPECT_FALSE(it.writer.arc(arc, text));
  EXPECT_THAT(text.lines, ElementsAre("G61G17G2X10Y0I5J0F600", "G17G2X0Y0I-5J0"));
  EXPECT_NEAR(text.seconds, 3.14159265, 1e-6);
}

TEST(MotionWriter, AFeedOfRotaryAxesIsTheDevicesOwnKind) {
  TextRules rules = three_axes();
  rules.axes[3] = TextRules::AxisRules{};
  Writer linear(rules);
  EXPECT_THAT(linear.line(point({{Axis::X, 3}, {Axis::A, 4}}), feed(600)).lines,
              ElementsAre("G61G1X3A4F600"));
  rules.feeds_all_axes = true;
  Writer all(rules);
  EXPECT_THAT(all.line(point({{Axis::X, 3}, {Axis::A, 4}}), feed(600)).lines,
              ElementsAre("G61G1X3A4F1000"));
  rules.times_rotary_axes = true;
  Writer timed(rules);
  EXPECT_THAT(timed.line(point({{Axis::X, 3}, {Axis::A, 4}}), feed(600)).lines,
              ElementsAre("G61G1X3A4G93F200"));
}

TEST(MotionWriter, AFeedIsThatOfXYZAndElseOfUVW) {
  TextRules rules = three_axes();
  rules.axes[6] = TextRules::AxisRules{};
  Writer it(rules);
  const Feed once_a_minute = Feed::inverse_time(1);
  EXPECT_THAT(it.line(point({{Axis::X, 3}, {Axis::U, 4}}), once_a_minute).lines,
              ElementsAre("G61G1X3U4F3"));
  EXPECT_THAT(it.line(point({{Axis::U, 9}}), once_a_minute).lines, ElementsAre("G1U9F5"));
  MotionText arc;
  EXPECT_FALSE(it.writer.arc({.origin = {},
                              .to = point({{Axis::X, 13}, {Axis::Y, 0}, {Axis::U, 99}}),
                              .center_first = Length::mm(8),
                              .center_second = Length::mm(0),
                              .turn = interpreter::Turn::Clockwise,
                              .sweep = Angle::degrees(180),
                              .feed = once_a_minute},
                             arc));
  EXPECT_THAT(arc.lines.front(), testing::EndsWith("F15.708")) << "the half circle's length";
  EXPECT_NEAR(arc.seconds, 60, 0.1);
}

TEST(MotionWriter, LongMovesAreWrittenInPiecesWhereTheDeviceHasLittleAhead) {
  TextRules rules = three_axes();
  rules.has_stop_mode = false;
  rules.seconds_ahead = 1;
  Writer it(rules);
  const MotionText text = it.line(point({{Axis::X, 10}, {Axis::Y, -1}}), feed(600));
  EXPECT_THAT(text.lines,
              ElementsAre("G1X2Y-0.2F600", "G1X4Y-0.4", "G1X6Y-0.6", "G1X8Y-0.8", "G1X10Y-1"));
  EXPECT_NEAR(text.seconds, std::sqrt(101) / 10, 1e-9);
  EXPECT_THAT(it.line(point({{Axis::X, 12}}), feed(600), true).lines, ElementsAre("G1X12", "G4P0"));
  EXPECT_THAT(it.line(point({{Axis::X, 12.004}}), feed(0.06)).lines,
              ElementsAre("G1X12.0005F0.06", "G1X12.0015", "G1X12.0025", "G1X12.004"))
      << "a step at least";
  MotionText arc;
  EXPECT_FALSE(it.writer.arc({.origin = {},
                              .to = point({{Axis::X, 2.004}, {Axis::Y, -1}}),
                              .center_first = Length::mm(7.004),
                              .center_second = Length::mm(-1),
                              .sweep = Angle::degrees(180),
                              .feed = feed(1200)},
                             arc));
  EXPECT_EQ(arc.lines.size(), 4U) << "0.785 s";
  EXPECT_EQ(arc.lines.back(), "G17G2X2.004Y-1I3.535534J3.535534");
}

// Else a feed that the axes cannot do puts long pieces ahead of them, and more time than is
// allowed.
TEST(MotionWriter, PiecesOfAnArcAreShortAtTheRatesOfTheAxesToo) {
  TextRules rules = three_axes();
  rules.seconds_ahead = 1;
  for (auto& axis : rules.axes)
    if (axis) axis->max_rate = 600;
  Writer it(rules);
  MotionText text;
  EXPECT_FALSE(it.writer.arc({.origin = {},
                              .to = point({{Axis::X, 20}, {Axis::Y, 0}}),
                              .center_first = Length::mm(10),
                              .center_second = Length::mm(0),
                              .sweep = Angle::degrees(180),
                              .feed = feed(90'000)},
                             text));
  EXPECT_NEAR(text.seconds, Angle::kPi, 1e-9);
  EXPECT_EQ(text.lines.size(), 13U);
}

TEST(MotionWriter, RefusesWhatTheDeviceCannotDo) {
  Writer it;
  (void)it.line(point({{Axis::X, 101}}), feed(600));
  EXPECT_EQ(it.refusal->text, "X 101 mm is outside the machine's travel of -100 to 100");
  it.writer.show_as({.units = interpreter::Units::Inch, .x_is_diameter = true});
  (void)it.line(point({{Axis::X, 101.6}}), feed(600));
  EXPECT_EQ(it.refusal->text, "X diameter 8 in is outside the machine's travel of -7.874 to 7.874");
  (void)it.line(point({{Axis::B, 1}}), feed(600));
  EXPECT_EQ(it.refusal->text, "the machine has no B axis");
  (void)it.line(point({{Axis::X, 1}}), feed(0));
  EXPECT_EQ(it.refusal->id, "MCH0003");
  (void)it.line(point({{Axis::X, 1}}), Feed::per_revolution(Length::mm(0.1)));
  EXPECT_EQ(it.refusal->id, "MCH0008");
  (void)it.line(point({{Axis::X, std::nan("")}}), feed(600));
  EXPECT_EQ(it.refusal->id, "MCH0006");
  EXPECT_THAT(it.writer.at(), testing::Each(0.0)) << "nothing of it is taken";
}

}  // namespace
}  // namespace dripline::machine::streamed
