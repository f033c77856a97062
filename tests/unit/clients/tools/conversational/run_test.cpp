#include <gtest/gtest.h>

#include "tests/unit/clients/tools/conversational/posted_run.hpp"

/// Posted programs run. Expected moves are computed from the events, not from the text.

namespace dripline::conversational {

// Posted geometry that the control computes while it runs.

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

const std::string kTool = event("tool_call",
                                "tool = 2\nfeed_per = \"minute\"\nfeed = 10\nspindle = \"rpm\"\n"
                                "speed = 500\nrestart = \"cw\"");
const std::string kOn = "spindle cw\n";

TEST(PostedRun, MovesToPositionsAndAlongGeometry) {  // CEN-232, CEN-233, CEN-244
  // Polar from X2 (radius 1), 2 long at 90 degrees: radius 3.
  EXPECT_EQ(run_of(kTool + event("position", "x = 2\nz = 0.5") +
                   event("line", "feed = 5\nz = \"-5/16\"") +
                   event("line", "coordinates = \"polar\"\nlength = 2\nangle = 90") +
                   event("arc",
                         "direction = \"cw\"\ncenter = \"absolute\"\nradius = 3\nxc = 0\n"
                         "zc = -0.3125\nx = 0\nz = 2.6875") +
                   event("arc", "direction = \"ccw\"\nk = 1\nend = \"incremental\"\nw = 2")),
            kOn +
                "rapid X2 Z.5\nline X2 Z-.3125\nline X6 Z-.3125\n"
                "arc cw X0 Z2.6875 about X0 Z-.3125 by 90\n"
                "arc ccw X0 Z4.6875 about X0 Z3.6875 by 180\n");
}

TEST(PostedRun, CutsBoxesByCyclesAAndB) {  // CEN-238
  EXPECT_EQ(run_of(kTool + event("cycle_a",
                                 "feed = 8\nstart_x = 3\nstart_z = 0.1\nx = 2.5\n"
                                 "z = -1")),
            kOn + "rapid X3 Z.1\nrapid X2.5 Z.1\nline X2.5 Z-1\nline X3 Z-1\nrapid X3 Z.1\n");
  EXPECT_EQ(run_of(kTool + event("cycle_b",
                                 "feed = 8\nstart_x = 3\nstart_z = 0.1\n"
                                 "dimensions = \"incremental\"\nu = -2\nw = -0.2")),
            kOn + "rapid X3 Z.1\nrapid X3 Z-.1\nline X1 Z-.1\nline X1 Z.1\nrapid X3 Z.1\n");
}

/// A step of X1 by 1 long in a bar of X2.
std::string step_pattern(const std::string& cycle, const std::string& fields) {
  return event(cycle, "start_x = 2.1\nstart_z = 0.1\npattern = 3\n" + fields) +
         event("line", "feed = \"rapid\"\nx = 1") + event("line", "feed = 6\nz = -1") +
         event("line", "x = 2.1") + event("end_cycle", "");
}

TEST(PostedRun, RoughsAndFinishesAPattern) {  // CEN-236, CEN-237
  // .05 are left at first, so the profile is at radius .55. Cuts at 1.05 + .05 - .2 = .9 and .7,
  // out along the shoulder to the previous cut and .02 further; then the pattern, then back to the
  // start.
  EXPECT_EQ(run_of(kTool +
                   step_pattern("rough_turning",
                                "x_rough_stock = 0.05\nz_rough_stock = 0\n"
                                "cut_increment = 0.2\nclearance = 0.02") +
                   event("finish_turning", "pattern = 3\nstart_x = 2.2\nstart_z = 0.2")),
            kOn +
                "rapid X2.1 Z.1\n"
                "rapid X1.8 Z.1\nline X1.8 Z-1\nline X2.1 Z-1\nrapid X2.14 Z-1\nrapid X2.14 Z.1\n"
                "rapid X1.4 Z.1\nline X1.4 Z-1\nline X1.8 Z-1\nrapid X1.84 Z-1\nrapid X1.84 Z.1\n"
                "rapid X1 Z.1\nline X1 Z-1\nline X2.1 Z-1\nrapid X2.1 Z.1\n"
                "rapid X2.2 Z.2\nrapid X1 Z.2\nline X1 Z-1\nline X2.1 Z-1\n"
                "rapid X2.2 Z-1\nrapid X2.2 Z.2\n");
}

TEST(PostedRun, RepeatsAPatternAndFinishesAFace) {  // CEN-236, CEN-237
  // Two passes take .1: the first is .05 off in radius. The finish retracts Z first, then X.
  EXPECT_EQ(
      run_of(kTool + step_pattern("pattern_repeat_facing", "x_rough_stock = 0.1\npasses = 2") +
             event("finish_facing", "pattern = 3\nstart_x = 2.2\nstart_z = 0.2")),
      kOn +
          "rapid X2.1 Z.1\n"
          "rapid X1.1 Z.1\nline X1.1 Z-1\nline X2.2 Z-1\nrapid X2.1 Z.1\n"
          "rapid X1 Z.1\nline X1 Z-1\nline X2.1 Z-1\nrapid X2.1 Z.1\n"
          "rapid X2.2 Z.2\nrapid X1 Z.2\nline X1 Z-1\nline X2.1 Z-1\n"
          "rapid X2.1 Z.2\nrapid X2.2 Z.2\n");
}

TEST(PostedRun, ThreadsByCycleOneAndByThreadLine) {  // CEN-238, CEN-240
  EXPECT_EQ(run_of(kTool + event("cycle_1",
                                 "start_x = 1.5\nstart_z = 0.25\nx = 1.2\nz = -0.75\n"
                                 "lead = \"1/8\"\nchamfer_length = 0\n"
                                 "chamfer_angle = 0")),
            kOn +
                "rapid X1.5 Z.25\nrapid X1.2 Z.25\nthread X1.2 Z-.75 lead .125\n"
                "rapid X1.5 Z-.75\nrapid X1.5 Z.25\n");
  EXPECT_EQ(run_of(kTool + event("position", "x = 1\nz = 0.2") +
                   event("thread_line", "z = -1\nthreads_per_unit = 20")),
            kOn + "rapid X1 Z.2\nthread X1 Z-1 lead .05\n");
}

TEST(PostedRun, DrillsBoresAndTaps) {  // CEN-241
  const std::string at = event("position", "x = 0\nz = 0.5");
  const std::string hole = "clearance = 0.1\nz = -0.4\nfeed = 4\n";
  const std::string there = kOn + "rapid X0 Z.5\nrapid X0 Z.1\nline X0 Z-.4\n";
  EXPECT_EQ(run_of(kTool + at + event("drill", hole)), there + "rapid X0 Z.1\n");
  EXPECT_EQ(run_of(kTool + at + event("drill", hole + "return = \"initial\"")),
            there + "rapid X0 Z.5\n");
  EXPECT_EQ(run_of(kTool + at + event("drill_dwell", hole + "dwell = 0.5")),
            there + "dwell .5\nrapid X0 Z.1\n");
  EXPECT_EQ(run_of(kTool + at + event("bore", hole)), there + "line X0 Z.1\n");
  EXPECT_EQ(run_of(kTool + at + event("bore_dwell", hole + "dwell = 1")),
            there + "dwell 1\nline X0 Z.1\n");
  // First to -.1, then .2 deeper, the rest last; each time back to R and down to .05 above.
  EXPECT_EQ(run_of(kTool + at +
                   event("drill_peck", hole + "first_depth = -0.1\nincrement = 0.2\n"
                                              "peck_clearance = 0.05")),
            kOn +
                "rapid X0 Z.5\nrapid X0 Z.1\nline X0 Z-.1\nrapid X0 Z.1\nrapid X0 Z-.05\n"
                "line X0 Z-.3\nrapid X0 Z.1\nrapid X0 Z-.25\nline X0 Z-.4\nrapid X0 Z.1\n");
}

TEST(PostedRun, CutsGrooves) {  // CEN-241
  // Pecks of .03 in radius from R: X2.04, 1.98, 1.92, the rest to 1.9; up .01, down to .005 above.
  EXPECT_EQ(run_of(kTool + event("position", "x = 2.2\nz = -1") +
                   event("diameter_grooving",
                         "feed = 2\nclearance = 2.1\nx = 1.9\n"
                         "increment = 0.03\npeck_up = 0.01\n"
                         "peck_clearance = 0.005")),
            kOn +
                "rapid X2.2 Z-1\nrapid X2.1 Z-1\nline X2.04 Z-1\nrapid X2.06 Z-1\n"
                "rapid X2.05 Z-1\nline X1.98 Z-1\nrapid X2 Z-1\nrapid X1.99 Z-1\n"
                "line X1.92 Z-1\nrapid X1.94 Z-1\nrapid X1.93 Z-1\nline X1.9 Z-1\n"
                "rapid X2.1 Z-1\n");
}

TEST(PostedRun, Taps) {  // CEN-241
  EXPECT_EQ(run_of(kTool + event("position", "x = 0\nz = 0.5") +
                   event("right_tap",
                         "threads_per_unit = 16\nspeed = 200\nclearance = 0.25\n"
                         "z = -0.5\nreturn = \"initial\"")),
            kOn +
                "rapid X0 Z.5\nspindle cw\nrapid X0 Z.25\nline X0 Z-.5\n"
                "spindle ccw\nline X0 Z.25\nspindle cw\nrapid X0 Z.5\n");
}

const std::string kThread =
    "start_z = 0.2\nz = -1\nlead = 0.1\nminimum_cut = 0.001\n"
    "finish_passes = 1\nmethod = 3\nchamfer_length = 0\nchamfer_angle = 0\n";

/// One pass: down at its shifted start, along, out and back.
std::string pass(const std::string& x, const std::string& z, const std::string& start_x) {
  return "rapid X" + x + " Z" + z + "\nthread X" + x + " Z-1 lead .1\nrapid X" + start_x +
         " Z-1\nrapid X" + start_x + " Z.2\n";
}

TEST(PostedRun, CutsAThreadInPasses) {  // CEN-239
  // Depths .02, .04, .05 below the crest of X2; a 90 degree nose shifts the start by what is left.
  EXPECT_EQ(run_of(kTool + event("multiple_thread", kThread + "root_x = 1.9\nheight = 0.05\n"
                                                              "start_x = 2.2\nfirst_cut = 0.02\n"
                                                              "nose_angle = 90")),
            kOn + "rapid X2.2 Z.2\n" + pass("1.96", ".23", "2.2") + pass("1.92", ".21", "2.2") +
                pass("1.9", ".2", "2.2"));
}

const std::string kNose = "[[tool]]\nnumber = 2\nradius = 0.01\ntip = 8\n";
const std::string kThreadTool =
    event("tool_change", "tool = 2\nspindle = \"rpm\"\nspeed = 500\nrestart = \"cw\"");
const std::string kChanged = "spindle off\ncoolant off\ntool 2\nstop\ntool 2\nspindle cw\n";

TEST(PostedRun, ComputesTheRootFromCrestAndNose) {  // CEN-239
  // A nose of .01 in a 60 degree groove stays .01/sin 30 - .01 = .01 from its root; a sharp thread
  // is .1/(2 tan 30) = .0866 high, so the height is .0766. Two cuts: .04 and the rest, the first
  // shifted by .0366 tan 30 = .0211. Outside the root is at 2 - .1532, inside at 1 + .1532.
  const std::string crest = kThread + "entry = \"crest\"\nfirst_cut = 0.04\nnose_angle = 60\n";
  EXPECT_EQ(
      run_of(kThreadTool + event("multiple_thread", crest + "start_x = 2.2\ncrest_x = 2"), kNose),
      kChanged + "rapid X2.2 Z.2\n" + pass("1.92", ".2211", "2.2") + pass("1.8468", ".2", "2.2"));
  EXPECT_EQ(
      run_of(kThreadTool + event("multiple_thread", crest + "start_x = 0.8\ncrest_x = 1"), kNose),
      kChanged + "rapid X.8 Z.2\n" + pass("1.08", ".2211", ".8") + pass("1.1532", ".2", ".8"));
}

TEST(PostedRun, ChangesToolsWithTheirMessage) {  // CEN-242
  // Spindle and coolant are switched off first; T0404 then selects the tool's offsets.
  EXPECT_EQ(run_of(event("tool_change",
                         "tool = 4\ndescription = \"BORE\"\nfeed = 0.01\n"
                         "speed = 300\nrestart = \"ccw\"\ncoolant = \"on\"")),
            "spindle off\ncoolant off\ntool 4\nmessage BORE\nstop\ntool 4\nspindle ccw\n"
            "coolant on\n");
}

TEST(PostedRun, TransformsTheMovesThatFollow) {  // CEN-243
  const std::string at = event("position", "x = 2\nz = 1");
  EXPECT_EQ(run_of(event("scaling", "i = 0\nk = 0\nx = 0.5\nz = 0.25") + at), "rapid X1 Z.25\n");
  EXPECT_EQ(run_of(event("rotation", "x = 0\nz = 0\naa = 90") + event("position", "x = 0\nz = 1")),
            "rapid X2 Z0\n");
  EXPECT_EQ(run_of(event("mirror", "z = 0") + at + event("mirror", "state = \"off\"") + at),
            "rapid X2 Z-1\nrapid X2 Z1\n");
  EXPECT_EQ(run_of(at + event("floating_zero", "x = 0\nz = 0") + event("position", "x = 1\nz = 0")),
            "rapid X2 Z1\nrapid X3 Z1\n");
}

TEST(PostedRun, StopsSwitchesAndCallsPrograms) {  // CEN-243
  EXPECT_EQ(run_of(event("miscellaneous",
                         "spindle_mode = \"rpm\"\nspeed = 100\nspindle = \"ccw\"\n"
                         "coolant = \"on\"\nstop = \"program\"") +
                       event("program_call", "program = 3\nrepeats = 2"),
                   "", "M30\nO0003\nG91 G0 X1\nG93\nM99\n"),
            "spindle ccw\ncoolant on\nstop\nrapid X1 Z0\nrapid X2 Z0\nspindle off\ncoolant off\n");
}

}  // namespace

}  // namespace dripline::conversational
