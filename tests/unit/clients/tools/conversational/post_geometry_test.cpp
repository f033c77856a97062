#include <gtest/gtest.h>

#include "tests/unit/clients/tools/conversational/posted_run.hpp"

namespace dripline::conversational {
namespace {

TEST(PostGeometry, PositionsRapidlyUnlessAFeedIsGiven) {  // CEN-233
  EXPECT_EQ(posted(event("position", "x = 2.5\nz = 0.2")), "G0 X2.5 Z.2\n");
  EXPECT_EQ(posted(event("position", "feed = 0.03\nz = -1")), "G1 F.03 Z-1\n");
  EXPECT_EQ(posted(event("position",
                         "coordinates = \"polar\"\npole = \"absolute\"\nxc = 3\nzc = -2\n"
                         "length = 1.5\nangle = 120")),
            "G0 R1.5 XC3 ZC-2 AB120\n");
}

TEST(PostGeometry, NamesTheCodeOfALineOnlyWhenItChanges) {  // CEN-233
  EXPECT_EQ(posted(event("line", "feed = \"rapid\"\nz = -2") + event("line", "x = 3") +
                   event("line", "x = 1.25\nz = -0.75") + event("line", "feed = 0.01\nz = 0.3") +
                   event("line", "feed = \"rapid\"\nx = 4")),
            "G0 Z-2\nG1 X3\nX1.25 Z-.75\nG1 F.01 Z.3\nG0 X4\n");
  EXPECT_EQ(posted(event("line", "z = 1") + event("miscellaneous", "stop = \"program\"") +
                   event("line", "z = 2")),
            "G1 Z1\nM0\nG1 Z2\n");
}

TEST(PostGeometry, PostsPolarLines) {  // CEN-233
  EXPECT_EQ(posted(event("line",
                         "feed = 0.025\ncoordinates = \"polar\"\npole = \"absolute\"\nxc = 2\n"
                         "zc = -3\nlength = 1.25\nangle = 30")),
            "G1 F.025 R1.25 XC2 ZC-3 AB30\n");
  EXPECT_EQ(posted(event("line", "coordinates = \"polar\"\nlength = \"3/4\"\nangle = 315")),
            "G1 R.75 AB315\n");
}

TEST(PostGeometry, EndsLinesWithCornersAndExtendsThemBack) {  // CEN-234
  EXPECT_EQ(posted(event("line",
                         "feed = 0.01\nx = 1\nz = -3\ncorner = \"round\"\n"
                         "corner_radius = 0.125")),
            "G1 F.01 X1 Z-3, R .125\n");
  EXPECT_EQ(posted(event("line", "x = 1\ncorner = \"chamfer\"\nchamfer_length = \"3/32\"")),
            "G1 X1, C .0938\n");
  EXPECT_EQ(posted(event("line", "x = 5\nz = -6\nextend_back = \"short\"\nextend_angle = 150")),
            "G1 X5 Z-6 BACK C0 W150\n");
  EXPECT_EQ(posted(event("line",
                         "x = 5\nz = -6\nextend_back = \"long\"\nextend_angle = -30\n"
                         "corner = \"round\"\ncorner_radius = 0.2")),
            "G1 X5 Z-6 BACK C2 W-30, R .2\n");
}

TEST(PostGeometry, PostsArcsByAnyCenterAndEnd) {  // CEN-233
  EXPECT_EQ(posted(event("arc",
                         "feed = 0.004\ndirection = \"cw\"\ni = 0.5\nk = -0.25\nx = 3\n"
                         "z = -1")),
            "G2 F.004 I.5 K-.25 X3 Z-1\n");
  EXPECT_EQ(posted(event("arc",
                         "feed = 0.004\ndirection = \"ccw\"\ncenter = \"absolute\"\n"
                         "radius = 1.5\nxc = 0\nzc = -1.5\nx = 0\nz = -3")),
            "G3 F.004 R1.5 XC0 ZC-1.5 X0 Z-3\n");
  EXPECT_EQ(posted(event("arc",
                         "direction = \"ccw\"\ncenter = \"polar\"\nradius = 0.75\n"
                         "aa = 90\nend = \"polar\"\nab = 170\ncorner = \"round\"\n"
                         "corner_radius = 0.1")),
            "G3 R.75 AA90 AB170, R .1\n");
  EXPECT_EQ(posted(event("arc", "center = \"radius only\"\nradius = 4\nx = 2\nz = -2") +
                   event("arc",
                         "center = \"radius only\"\nradius = 4\nlength = \"long\"\n"
                         "end = \"incremental\"\nu = 1\nw = -0.5")),
            "G2 R4 X2 Z-2\nG2 R-4 U1 W-.5\n");
  EXPECT_EQ(posted(event("arc", "k = 1") + event("line", "z = 3")), "G2 K1\nG1 Z3\n");
}

const std::string kCircles =
    "r1 = 2\nxc1 = 1\nzc1 = 0.5\nr2 = 1.25\nxc2 = 6\nzc2 = 7\ndirection = \"ccw\"\n";
const std::string kCircleParameters = "P90 = .5\nP91 = 1\nP92 = 2\nP93 = 7\nP94 = 6\nP95 = 1.25\n";

TEST(PostGeometry, ConnectsArcsByATangentLine) {  // CEN-235
  const auto connect = [](const std::string& sides) {
    return posted(event("tangents", kCircles + sides));
  };
  const std::string tail = "G3 XC[P91] ZC[P90] R[P92] X[P81] Z[P80]\nG1 X[P83] Z[P82]\n";
  EXPECT_EQ(connect("exit = \"right\"\nenter = \"right\""), kCircleParameters + "TANL C0\n" + tail);
  EXPECT_EQ(connect("exit = \"left\"\nenter = \"right\""), kCircleParameters + "TANL C1\n" + tail);
  EXPECT_EQ(connect("exit = \"right\"\nenter = \"left\""), kCircleParameters + "TANL C2\n" + tail);
  EXPECT_EQ(connect("exit = \"left\"\nenter = \"left\""), kCircleParameters + "TANL C3\n" + tail);
}

TEST(PostGeometry, ConnectsArcsByATangentArc) {  // CEN-235
  const struct {
    std::string exit, enter, center;
    int number;
  } cases[] = {{"right", "right", "left", 0}, {"left", "right", "left", 1},
               {"right", "left", "left", 2},  {"left", "left", "left", 3},
               {"left", "left", "right", 4},  {"right", "left", "right", 5},
               {"left", "right", "right", 6}, {"right", "right", "right", 7}};
  for (const auto& one : cases) {
    const std::string fields = "exit = \"" + one.exit + "\"\nenter = \"" + one.enter +
                               "\"\nconnect = \"arc\"\narc_center = \"" + one.center +
                               "\"\narc_radius = 9\narc_direction = \"cw\"";
    EXPECT_EQ(posted(event("tangents", kCircles + fields)),
              kCircleParameters + "P96 = 9\nTANA C" + std::to_string(one.number) +
                  "\nG3 XC[P91] ZC[P90] R[P92] X[P81] Z[P80]\n"
                  "G2 XC[P85] ZC[P84] R[P96] X[P83] Z[P82]\n");
  }
}

TEST(PostGeometry, PutsAnArcThroughThreePoints) {  // CEN-235
  const std::string points = "x1 = 2\nz1 = -1\nx2 = 4\nz2 = -1.5\nx3 = 5\nz3 = -3\n";
  const std::string code =
      "P90 = -1\nP91 = 2\nP92 = -1.5\nP93 = 4\nP94 = -3\nP95 = 5\nCGEN\nG2 IF P97=3 THEN G3\n";
  EXPECT_EQ(posted(event("cgen", points)), code + "XC[P81] ZC[P80] R[P82] X[P95] Z[P94]\n");
  EXPECT_EQ(posted(event("cgen", points + "end_at_point_3 = false\nab = 15")),
            code + "XC[P81] ZC[P80] R[P82] AB15\n");
}

TEST(PostGeometry, PostsThreadLines) {  // CEN-240
  EXPECT_EQ(posted(event("thread_line",
                         "x = 1.5\nz = -2\nthreads_per_unit = 11.5\n"
                         "start_angle = 180")),
            "G32 E11.5 Q180 G1 X1.5 Z-2\n");
  EXPECT_EQ(posted(event("thread_line",
                         "z = -2\nlead = \"1/13\"\nextend_back = \"short\"\n"
                         "extend_angle = 170")),
            "G32 F.076923 G1 Z-2 BACK C0 W170\n");
}

}  // namespace
}  // namespace dripline::conversational
