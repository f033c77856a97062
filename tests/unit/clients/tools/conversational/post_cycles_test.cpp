#include <gtest/gtest.h>

#include "tests/unit/clients/tools/conversational/posted_run.hpp"

namespace dripline::conversational {
namespace {

const std::string kStocks =
    "x_finish_stock = 0.02\nz_finish_stock = 0.01\nx_rough_stock = 0.03\nz_rough_stock = 0.015\n";
const std::string kStart = "start_x = 3.25\nstart_z = 0.2\n";
const std::string kPattern = "pattern = 5\n";

TEST(PostCycles, PostsRoughTurningAndItsPattern) {  // CEN-236
  EXPECT_EQ(posted(event("rough_turning", kStocks + kStart + kPattern +
                                              "first_depth = 3.1\ncut_increment = 0.075\n"
                                              "clearance = 0.05\ncompensation = \"right\"") +
                   event("line", "feed = \"rapid\"\nx = 1") + event("end_cycle", "")),
            "G0 Z.2 X3.25\nP140 = .2\nP139 = 3.25\nP117 = 0\n"
            "G71 P9805 Q9905 U.02 W.01 I.03 K.015 R.05 V3.1 D.075\n"
            "N9805\nG42\nG0 X1\nN9905\n");
}

TEST(PostCycles, PostsRoughFacingWith45DegreeRelief) {  // CEN-236
  EXPECT_EQ(posted(event("rough_facing", kStart + "pattern = 12\ncut_increment = 0.05\n"
                                                  "relief = \"45 degrees\"\nclearance = 0\n"
                                                  "compensation = \"left\"") +
                   event("end_cycle", "")),
            "G0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\nP117 = 1\n"
            "G72 P9812 Q9912 R0 D.05\nN9812\nG41\nN9912\n");
}

TEST(PostCycles, PostsPatternRepeatsAlikeForTurningAndFacing) {  // CEN-236
  const std::string fields = kStocks + kStart + kPattern + "passes = 3";
  for (const std::string type : {"pattern_repeat_turning", "pattern_repeat_facing"}) {
    EXPECT_EQ(posted(event(type, fields) + event("end_cycle", "")),
              "G0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\nG73 P9805 Q9905 U.02 W.01 I.03 K.015 D3\n"
              "N9805\nG40\nN9905\n");
  }
}

TEST(PostCycles, FinishesAndRetractsInTheOrderOfTheWork) {  // CEN-237
  const std::string pattern =
      event("pattern_repeat_turning", kStart + kPattern + "passes = 2") + event("end_cycle", "");
  const std::string before =
      "G0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\nG73 P9805 Q9905 D2\nN9805\nG40\nN9905\n";
  EXPECT_EQ(posted(pattern + event("finish_turning", kPattern + "feed = 0.004\nspeed = 700\n"
                                                                "start_x = 3.5\nstart_z = 0.1")),
            before +
                "F.004\nS700\nG0 X3.5 Z.1\nP140 = .1\nP139 = 3.5\nG70 P9805 Q9905\n"
                "G0 X3.5\nZ.1\n");
  EXPECT_EQ(posted(pattern + event("finish_facing", kPattern + "start_x = 3.5\nstart_z = 0.1")),
            before + "G0 X3.5 Z.1\nP140 = .1\nP139 = 3.5\nG70 P9805 Q9905\nG0 Z.1\nX3.5\n");
}

TEST(PostCycles, PostsCyclesAAndB) {  // CEN-238
  EXPECT_EQ(posted(event("cycle_a", kStart + "compensation = \"right\"\nfeed = 0.015\n"
                                             "speed = 350\nx = 2.75\nz = -2\n"
                                             "taper = \"tapered\"\ni = -0.125")),
            "G0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\nS350\nG42 G90 I-.125 X2.75 Z-2 F.015\n");
  EXPECT_EQ(posted(event("cycle_b", kStart + "compensation = \"left\"\nfeed = 0.015\n"
                                             "dimensions = \"incremental\"\nu = -3\nw = -0.3\n"
                                             "taper = \"tapered\"\nk = 0.1")),
            "G0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\nG41 G94 K.1 U-3 W-.3 F.015\n");
}

TEST(PostCycles, PostsTheSingleThread) {  // CEN-238
  EXPECT_EQ(posted(event("cycle_1", kStart + "x = 2.9\nz = -1.5\nlead = 0.125\nstart_angle = 90\n"
                                             "chamfer_length = 0.1\nchamfer_angle = 45")),
            "G0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\nP103 = .1\nP104 = 45\n"
            "G40 G92 X2.9 Z-1.5 Q90 F.125\n");
}

const std::string kThread =
    "z = -1.5\nlead = 0.1\nfirst_cut = 0.02\nnose_angle = 60\nminimum_cut = 0.003\n"
    "finish_passes = 2\nmethod = 2\nchamfer_length = 0.05\nchamfer_angle = 30\n";
const std::string kThreadHead =
    "P103 = .05\nP104 = 30\nP130 = .003\nP131 = 2\nG0 X3.25 Z.2\nP140 = .2\nP139 = 3.25\n";

TEST(PostCycles, PostsAThreadByRootAndHeight) {  // CEN-239
  EXPECT_EQ(posted(event("multiple_thread", kStart + kThread +
                                                "root_x = 2.8\nheight = 0.0613\n"
                                                "start_angle = 0\ntaper = \"tapered\"\ni = 0.05")),
            kThreadHead + "G76 X2.8 Z-1.5 I.05 Q0 F.1 K.0613 A60 D.02 P2\n");
}

TEST(PostCycles, ComputesAThreadGivenByItsCrest) {  // CEN-239
  const std::string file =
      event("multiple_thread", kStart + kThread + "entry = \"crest\"\ncrest_x = 2.9226");
  const auto crest = [](const std::string& truncation) {
    return kThreadHead + "P91 = 2.9226\nP101 = .1\nP108 = 60\n" + truncation +
           "P106 = P101/[2*TAN[P108/2]] - P124\nP124 = P91-2*P106\n"
           "IF P139 < P91 THEN P124 = P91+2*P106\nG76 X[P124] Z-1.5 F.1 K[P106] A60 D.02 P2\n";
  };
  EXPECT_EQ(posted(file), crest("P124 = P261/SIN[P108/2] - P261\n"));
  EXPECT_EQ(posted(file, {.has_printed_crest_formula = true}),
            crest("P92 = P262\nP262 = 0\nG65 G42 G0 XC0 ZC0 R2 AB[90-P108/2]\nG65 X0 Z0\n"
                  "G65 G40 R2 AB[90+P108/2]\nP124 = P209*2 - P261\nP262 = P92\n"));
}

const std::string kHole = "clearance = 0.15\nz = -1.2\nfeed = 0.006\n";

TEST(PostCycles, PostsHoles) {  // CEN-241
  EXPECT_EQ(posted(event("drill", kHole)), "G81 R.15 Z-1.2 F.006 G39\n");
  EXPECT_EQ(posted(event("drill", kHole + "return = \"initial\"")), "G81 R.15 Z-1.2 F.006 G38\n");
  EXPECT_EQ(posted(event("drill_dwell", kHole + "dwell = 0.25")),
            "G82 P.25 R.15 Z-1.2 F.006 G39\n");
  EXPECT_EQ(posted(event("drill_peck", kHole + "first_depth = -0.4\nincrement = 0.3\n"
                                               "peck_clearance = 0.04")),
            "G83 Q.3 E.04 V-.4 R.15 Z-1.2 F.006 G39\n");
  EXPECT_EQ(posted(event("bore", kHole)), "G85 R.15 Z-1.2 F.006 G39\n");
  EXPECT_EQ(posted(event("bore_dwell", kHole + "dwell = 1")), "G89 P1 R.15 Z-1.2 F.006 G39\n");
}

TEST(PostCycles, PostsTapsWithTheSpindleTheyNeed) {  // CEN-241
  const std::string tap = "threads_per_unit = 18\nclearance = 0.2\nz = -0.9\n";
  EXPECT_EQ(posted(event("right_tap", tap + "speed = 200")),
            "G97 G99 M3 S200\nG84 F[1/18] R.2 Z-.9 G39\n");
  EXPECT_EQ(posted(event("left_tap", tap + "return = \"initial\"")),
            "G97 G99 M4\nG84 F[1/18] R.2 Z-.9 G38\n");
}

TEST(PostCycles, PostsGrooves) {  // CEN-241
  EXPECT_EQ(posted(event("face_grooving",
                         kHole + "x = 2\nfirst_depth = -0.2\nincrement = 0.15\n"
                                 "peck_clearance = 0.02\npeck_up = 0.01\nstep = 0.1\n"
                                 "relief = 0.03\nx_finish_stock = 0.005\nz_finish_stock = 0.004")),
            "G74 Q.15 U.01 E.02 V-.2 X2 I.1 D.03 A.005 C.004 R.15 Z-1.2 F.006 G39\n");
  EXPECT_EQ(posted(event("diameter_grooving",
                         "clearance = 2.2\nx = 1.5\nz = -2\nincrement = 0.08\n"
                         "step = 0.11\nreturn = \"initial\"")),
            "G75 Q.08 X1.5 K.11 R2.2 Z-2 G38\n");
}

}  // namespace
}  // namespace dripline::conversational
