#include <gtest/gtest.h>
#include <cmath>

#include "clients/tools/offline/offline_run.hpp"
#include "tests/unit/gateway/interpreter/dialects/rs274ngc/control_run.hpp"

/// Rows: NGC-090
namespace dripline::interpreter::rs274ngc {
namespace {

struct Point {
  double x = 0, y = 0;
};

class PointLog final : public EventSink {
 public:
  void on_line(const Line& event) override {
    points.push_back({event.to.raw(Axis::X), event.to.raw(Axis::Y)});
  }
  void on_alarm(const Alarm& event) override { alarm = event.diagnostic.id; }
  std::vector<Point> points;
  std::string alarm;
};

PointLog trace(const std::string& text, double tolerance = 0.001) {
  const auto setup = parse_setup(
      "[control]\nprofile = \"linuxcnc\"\nspline_tolerance = " + std::to_string(tolerance) + "\n");
  PointLog log;
  MemorySource source(text);
  EXPECT_TRUE(run_offline(**find_dialect("rs274ngc"), *setup, source, log));
  return log;
}

TEST(Rs274Spline, ARationalQuarterIsACircleWithinTheTolerance) {
  for (const double tolerance : {0.001, 0.1}) {
    const PointLog log =
        trace("G21 F100 G1 X50 Y0\nG5.2 X50 Y50 P[SQRT[2]/2]\nX0 Y50 P1\nG5.3\nM2\n", tolerance);
    ASSERT_GT(log.points.size(), 5u);
    for (std::size_t i = 1; i < log.points.size(); ++i) {
      const Point& a = log.points[i - 1];
      const Point& b = log.points[i];
      EXPECT_NEAR(std::hypot(b.x, b.y), 50, 1e-9);
      EXPECT_GE(std::hypot((a.x + b.x) / 2, (a.y + b.y) / 2), 50 - tolerance);
    }
    EXPECT_NEAR(log.points.back().y, 50, 1e-12);
    EXPECT_LT(log.points.size(), 3 * 50 * 1.6 / std::sqrt(8 * 50 * tolerance)) << "not too fine";
  }
}

/// Points of one straight line, whatever their weights and the order, are a straight line.
TEST(Rs274Spline, HighOrdersAndWeightsStayWhereTheirPointsAre) {
  std::string text = "G21 F100\nG5.2 P3 L20\n";
  for (int i = 1; i <= 30; ++i) {
    text += "X" + std::to_string(i) + " Y" + std::to_string(2 * i) + " P" +
            std::to_string(1 + i % 7) + "\n";
  }
  const PointLog log = trace(text + "G5.3\nM2\n");
  ASSERT_FALSE(log.points.empty());
  double last = 0;
  for (const Point& point : log.points) {
    EXPECT_NEAR(point.y, 2 * point.x, 1e-9);
    EXPECT_GT(point.x, last);
    last = point.x;
  }
  EXPECT_EQ(last, 30);
}

/// An S that is level with its chord at its middle has to be seen all the same.
TEST(Rs274Spline, AnSIsNoStraightLine) {
  const PointLog log = trace("G21 F100\nG5 X30 Y0 I10 J30 P-10 Q-30\nM2\n");
  double highest = 0;
  for (const Point& point : log.points) highest = std::max(highest, point.y);
  EXPECT_NEAR(highest, 90 * 0.211325 * 0.788675 * 0.57735, 0.01);  // 90 t (1-t) (1-2t)
}

TEST(Rs274Spline, BoundsAreKept) {
  std::string text = "G21 F100\nG5.2 P1\n";
  for (int i = 0; i < 1000; ++i) text += "X" + std::to_string(i) + " Y1 P1\n";
  EXPECT_EQ(trace(text + "G5.3\nM2\n").alarm, "NGC0331");
  EXPECT_EQ(trace("G21 F100\nG5.2 X1 Y1 P1 L21\nM2\n").alarm, "NGC0331");
  std::string wild = "G21 F100\nG5.2 P1\n";
  for (int i = 0; i < 900; ++i) {
    wild += "X" + std::to_string(i % 2 * 900000) + " Y" + std::to_string(i % 3 * 900000) + " P1\n";
  }
  EXPECT_EQ(trace(wild + "G5.3\nM2\n", 1e-6).alarm, "NGC0331");
  EXPECT_EQ(trace("G21 F100\nG5.2 X1 Y1 P[1/10**300]\nX2 Y0 P[1/10**300]\nG5.3\nM2\n").alarm, "");
}

constexpr std::string_view kSetup =
    "[control]\nprofile = \"linuxcnc\"\n[[tool]]\nnumber = 1\nlength = 5.0\n"
    "[[tool]]\nnumber = 4\nlength = 7.0\nradius = 1.0\n";

TEST(Rs274Spline, OpenCurvesAndWrittenToolsSurviveASnapshot) {
  const std::string program =
      "G21 F100\nG10 L1 P4 Z3 R2 Q6\nG5.2 P2 L4\nX1 Y2 P1\nX3 Y2 P1\nX5 Y0 P0.5\nG5.3\n"
      "G43 H4 G0 Z1\nG0 X#5422\nG18 G41 D4 G1 Z9\nZ12\nM2\n";
  for (std::uint64_t cut = 1; cut < 12; ++cut) {
    ControlRun whole(program, kSetup);
    ASSERT_EQ(whole.step(), StepState::Ended);
    ControlRun first(program, kSetup);
    ASSERT_EQ(first.step(cut), StepState::Ran);
    ControlRun second(program, kSetup);
    ASSERT_TRUE(second.interpreter().restore(first.interpreter().snapshot()));
    EXPECT_EQ(second.interpreter().snapshot().digest(), first.interpreter().snapshot().digest());
    EXPECT_EQ(second.step(), StepState::Ended);
    std::vector<std::string> both = first.log().lines();
    both.insert(both.end(), second.log().lines().begin(), second.log().lines().end());
    EXPECT_EQ(both, whole.log().lines()) << "cut after " << cut;
  }
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
