#include <gtest/gtest.h>

#include "tests/unit/clients/tools/conversational/posted_run.hpp"

/// Posted geometry that the control computes while it runs.
namespace dripline::conversational {
namespace {

const std::string kFeed = event("miscellaneous", "feed_per = \"minute\"\nfeed = 10");

std::string geometry(const std::string& body) {
  return run_of(kFeed + body);
}

TEST(PostedGeometry, RoundsAndBreaksCorners) {  // CEN-234
  // A square corner at X2 Z-1; .25 of each side is cut off.
  const std::string before = event("position", "x = 2\nz = 0");
  const std::string after = event("line", "x = 4");
  EXPECT_EQ(
      geometry(before + event("line", "z = -1\ncorner = \"round\"\ncorner_radius = 0.25") + after),
      "rapid X2 Z0\nline X2 Z-.75\narc cw X2.5 Z-1 about X2.5 Z-.75 by 90\nline X4 Z-1\n");
  EXPECT_EQ(geometry(before + event("line", "z = -1\ncorner = \"chamfer\"\nchamfer_length = 0.25") +
                     after),
            "rapid X2 Z0\nline X2 Z-.75\nline X2.5 Z-1\nline X4 Z-1\n");
}

TEST(PostedGeometry, ExtendsLinesBack) {  // CEN-234
  // Back from radius 2 at Z-3 under 135 degrees: radius 1 is reached one further, at Z-2.
  EXPECT_EQ(geometry(event("position", "x = 2\nz = 0") + event("line", "z = -1") +
                     event("line", "x = 4\nz = -3\nextend_back = \"short\"\nextend_angle = 135")),
            "rapid X2 Z0\nline X2 Z-2\nline X4 Z-3\n");
}

const std::string kStart = event("position", "x = 0\nz = -1");
const std::string kCircles =
    "direction = \"cw\"\nr1 = 1\nxc1 = 0\nzc1 = 0\nr2 = 1\nxc2 = 0\nzc2 = 4\n";
const std::string kSecond = event(
    "arc", "direction = \"cw\"\ncenter = \"absolute\"\nradius = 1\nxc = 0\nzc = 4\nx = 0\nz = 5");

TEST(PostedGeometry, ConnectsArcsByATangentLine) {  // CEN-235
  EXPECT_EQ(geometry(kStart + event("tangents", kCircles) + kSecond),
            "rapid X0 Z-1\narc cw X2 Z0 about X0 Z0 by 90\nline X2 Z4\n"
            "arc cw X0 Z5 about X0 Z4 by 90\n");
}

TEST(PostedGeometry, ConnectsArcsByATangentArc) {  // CEN-235
  // Center at Z2, radius 1.5 up: 2.5 from both, 1.5 + 1. The points are .8, .6 from the centers.
  EXPECT_EQ(geometry(kStart +
                     event("tangents", kCircles + "connect = \"arc\"\narc_radius = 1.5\n"
                                                  "arc_direction = \"ccw\"") +
                     kSecond),
            "rapid X0 Z-1\narc cw X1.2 Z.8 about X0 Z0 by 143.1301\n"
            "arc ccw X1.2 Z3.2 about X3 Z2 by 106.2602\narc cw X0 Z5 about X0 Z4 by 143.1301\n");
}

TEST(PostedGeometry, RunsThroughThreePoints) {  // CEN-235
  // 5, 0 and 4, 3 and 3, 4 are on a circle of 5 about the zero point.
  const std::string points = "x1 = 0\nz1 = 5\nx2 = 6\nz2 = 4\nx3 = 8\nz3 = 3\n";
  const std::string start = event("position", "x = 0\nz = 5");
  EXPECT_EQ(geometry(start + event("cgen", points)),
            "rapid X0 Z5\narc ccw X8 Z3 about X0 Z0 by 53.1301\n");
  EXPECT_EQ(geometry(start + event("cgen", points + "end_at_point_3 = \"no\"\nab = 90")),
            "rapid X0 Z5\narc ccw X10 Z0 about X0 Z0 by 90\n");
}

}  // namespace
}  // namespace dripline::conversational
