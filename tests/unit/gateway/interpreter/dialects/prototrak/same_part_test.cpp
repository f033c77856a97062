#include <fmt/core.h>
#include <gtest/gtest.h>
#include <cmath>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

/// One part, written with the control's own events and as the tool-center path of a Fanuc post,
/// gives the same path to 0.0001 inch. Rows: PT-26, PT-28, PT-29, PT-31.
namespace dripline::interpreter {
namespace {

class EndPoints final : public EventSink {
 public:
  void on_rapid(const Rapid& event) override { add(event.to); }
  void on_line(const Line& event) override { add(event.to); }
  void on_arc(const Arc& event) override { add(event.to); }
  void on_alarm(const Alarm& event) override { ADD_FAILURE() << event.diagnostic.text; }
  struct Point {
    double x, y;
  };
  std::vector<Point> points;

 private:
  void add(const Position& to) {
    const Point point{to.linear(Axis::X).inch(), to.linear(Axis::Y).inch()};
    if (!points.empty() && std::hypot(point.x - points.back().x, point.y - points.back().y) < 1e-5)
      return;
    points.push_back(point);
  }
};

std::vector<EndPoints::Point> path_of(std::string_view text) {
  MemorySource source(text);
  EndPoints sink;
  auto interpreter = (*find_dialect("prototrak-plus"))->make(Setup{}, source, sink);
  while ((*interpreter)->step(100) == StepState::Ran) {
  }
  return sink.points;
}

TEST(SamePart, IsTheSamePathInBothForms) {
  // A cam of our own: an arc of radius 1.5 about the origin, a line up, a conrad of .6, a line
  // back. Tool .5 on the right: outside. The end points of the second form were worked out by hand:
  // 1.5 + .25 = 1.75; the corner at (0, 1.5) turns left from -X to (-2, -.5)'s direction, so its
  // arc of .25 ends on the normal of the line; the conrad's path radius is .85.
  const auto native = path_of(
      "PN7 G20 ;\n"
      "N1 G103 XB0 YB-1.5 XE0 YE1.5 XC0 YC0 F90 TC1 D0.5 CR0 T1 ;\n"
      "N2 G101 XB0I YB0I XE-2. YE1. CR0.6 ;\n"
      "N3 G101 XB0I YB0I XE0 YE-1.5 CR- ;\n"
      "%");
  ASSERT_EQ(native.size(), 6U);
  const double a = std::atan2(-0.5, -2.0);  // direction of the second element
  const double b = std::atan2(-2.5, 2.0);   // of the third
  const auto right_of = [](double x, double y, double direction, double by) {
    return EndPoints::Point{x + by * std::sin(direction), y - by * std::cos(direction)};
  };
  const double turn = std::fmod(b - a + 4 * Angle::kPi, 2 * Angle::kPi);
  const double cut = 0.6 * std::tan(turn / 2);
  const auto first = right_of(0, 1.5, a, 0.25);
  const auto into = right_of(-2 - cut * std::cos(a), 1 - cut * std::sin(a), a, 0.25);
  const auto out = right_of(-2 + cut * std::cos(b), 1 + cut * std::sin(b), b, 0.25);
  const auto last = right_of(0, -1.5, b, 0.25);
  const std::string converted = fmt::format(
      "%:CAM;\nN1 G00 G90 X0 Y-1.75 T1;\nN2 G03 X0 Y1.75 I0 J1.75 F90;\n"
      "N3 G03 X{:.4f} Y{:.4f} I0 J-.25;\nN4 G01 X{:.4f} Y{:.4f};\n"
      "N5 G03 X{:.4f} Y{:.4f} I{:.4f} J{:.4f};\nN6 G01 X{:.4f} Y{:.4f};\n%",
      first.x, first.y, into.x, into.y, out.x, out.y, -0.85 * std::sin(a), 0.85 * std::cos(a),
      last.x, last.y);
  const auto fanuc = path_of(converted);
  ASSERT_EQ(fanuc.size(), native.size()) << converted;
  for (std::size_t i = 0; i < native.size(); ++i) {
    EXPECT_NEAR(native[i].x, fanuc[i].x, 1e-4) << i;
    EXPECT_NEAR(native[i].y, fanuc[i].y, 1e-4) << i;
  }
}

}  // namespace
}  // namespace dripline::interpreter
