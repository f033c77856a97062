#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

// Rows: HD-076 (the datum is set).
class DncTouch : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};
};

TEST_F(DncTouch, MeasuresABoreAndGivesTheDatum) {
  dnc.write(
      "bore.toml",
      "[probe]\nsurface = [ { cylinder = { center = { X = 12.0, Y = 3.0 }, radius = 18.0 } } ]\n");
  const auto done = dnc({"touch", "circle", "--setup", "bore.toml", "--datum", "50,10", "--json",
                         "X+:10,5,-5", "X-:10,5,-5", "Y+:12,5,-5", "Y-:12,5,-5"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto measured = json::parse(done.out).at("measured");
  EXPECT_NEAR(measured.at("X").get<double>(), 12, 1e-6);
  EXPECT_NEAR(measured.at("Y").get<double>(), 3, 1e-6);
  EXPECT_NE(json::parse(done.out).at("setup").get<std::string>().find("name = \"datum\""),
            std::string::npos);
}

// HD-211, HD-213: under the basic rotation the point has the coordinates the operator gave.
TEST_F(DncTouch, GivesADatumForTheBasicRotation) {
  dnc.write("bore.toml",
            "[probe]\nsurface = [ { cylinder = { center = { X = 12.0, Y = 3.0 }, radius = 18.0 } } "
            "]\n[control]\nbasic_rotation = 90\n[[offset]]\nname = \"datum\"\nZ = 5\n");
  const auto done = dnc({"touch", "circle", "--datum", "50,10", "--setup", "bore.toml",
                         "X+:12,3,-5", "X-:12,3,-5", "Y+:12,3,-5", "Y-:12,3,-5"});
  ASSERT_EQ(done.status, 0) << done.err;
  // 50, 10 turned by 90 degrees is -10, 50
  EXPECT_NE(done.out.find("units = \"mm\"\n\n[[offset]]\nname = \"datum\"\nX = 22\nY = -47\nZ = "
                          "5\n"),
            std::string::npos)
      << done.out;
}

/// The datum and the basic rotation as a run takes them.
TEST_F(DncTouch, GivesADatumThatARunHas) {
  dnc.write("bore.toml",
            "[probe]\nsurface = [ { cylinder = { center = { X = 12.0, Y = 3.0 }, radius = 18.0 } } "
            "]\n[control]\nbasic_rotation = 30\n");
  const auto done = dnc({"touch", "circle", "--setup", "bore.toml", "--datum", "50,10", "--json",
                         "X+:12,3,-5", "X-:12,3,-5", "Y+:12,3,-5", "Y-:12,3,-5"});
  ASSERT_EQ(done.status, 0) << done.err;
  dnc.write("then.toml", json::parse(done.out).at("setup").get<std::string>() +
                             "[control]\nbasic_rotation = 30\n");
  dnc.write("go.h", "BEGIN PGM 1 MM\nL X+50 Y+10 R0 F9999\nEND PGM 1 MM\n");
  const auto run = dnc({"trace", "go.h", "--setup", "then.toml"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("\"X\":12"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\"Y\":3"), std::string::npos) << run.out;
}

// HD-212: the touch points of the basic rotation are a side of the corner, or all is probed again.
TEST_F(DncTouch, TakesTheTouchPointsOfTheBasicRotationForACorner) {
  const std::string probe =
      "[probe]\nsurface = [ { axis = \"Y\", at = 20.0 }, { axis = \"X\", at = 50.0 } ]\n";
  dnc.write("vice.toml", probe);
  const auto rotation =
      dnc({"touch", "rotation", "--setup", "vice.toml", "Y+:10,0,-5", "Y+:40,0,-5", "--json"});
  ASSERT_EQ(rotation.status, 0) << rotation.err;
  const auto keeps = json::parse(rotation.out).at("setup").get<std::string>();
  EXPECT_NE(keeps.find("basic_rotation_touches = [\"Y+:10,20,-5\", \"Y+:40,20,-5\"]"),
            std::string::npos)
      << keeps;
  dnc.write("turned.toml", keeps + probe);
  const auto corner = dnc({"touch", "corner", "--setup", "turned.toml", "--rotation-touches",
                           "--json", "X+:0,30,-5", "X+:0,60,-5"});
  ASSERT_EQ(corner.status, 0) << corner.err;
  EXPECT_EQ(json::parse(corner.out).at("measured").at("X"), 50);
  EXPECT_EQ(json::parse(corner.out).at("measured").at("Y"), 20);
  EXPECT_EQ(json::parse(corner.out).at("touched").size(), 4u);
  // NO ENT: all four, also where points are kept
  const auto again = dnc({"touch", "corner", "--setup", "turned.toml", "X+:0,30,-5", "X+:0,60,-5"});
  EXPECT_EQ(again.status, 2);
  EXPECT_EQ(again.err, "dnc: corner takes 4 touches, 2 are given\n");
  const auto none = dnc({"touch", "corner", "--setup", "vice.toml", "--rotation-touches",
                         "X+:0,30,-5", "X+:0,60,-5"});
  EXPECT_EQ(none.err, "dnc: vice.toml has no touch points of a basic rotation\n");
  const auto same = dnc({"touch", "corner", "--setup", "turned.toml", "--rotation-touches",
                         "Y+:0,0,-5", "Y+:5,0,-5"});
  EXPECT_EQ(same.status, 2);
  EXPECT_NE(same.err.find("touch 3 is Y+: expected the other axis"), std::string::npos) << same.err;
  // what was kept is no obstacle to a run
  dnc.write("go.h", "BEGIN PGM 1 MM\nL X+50 Y+10 R0 F9999\nEND PGM 1 MM\n");
  EXPECT_EQ(dnc({"check", "go.h", "--setup", "turned.toml"}).status, 0);
}

TEST_F(DncTouch, SpeaksTheSetupsUnitsToTheSetup) {
  dnc.write("inch.toml", "units = \"in\"\n[probe]\nsurface = [ { axis = \"X\", at = 2.0 } ]\n");
  const auto metric = dnc({"touch", "surface", "--setup", "inch.toml", "X+:0,0,0"});
  ASSERT_EQ(metric.status, 0) << metric.err;
  EXPECT_NE(metric.out.find("X +50.8000\n"), std::string::npos) << metric.out;
  EXPECT_NE(metric.out.find("units = \"in\"\n\n[[offset]]\nname = \"datum\"\nX = 2\n"),
            std::string::npos)
      << metric.out;
  const auto inch = dnc({"touch", "surface", "--inch", "--setup", "inch.toml", "--ball", "0.1",
                         "--datum", "-0.5", "X+:1,0,0", "--json"});
  ASSERT_EQ(inch.status, 0) << inch.err;
  const auto report = json::parse(inch.out);
  EXPECT_EQ(report.at("units"), "in");
  EXPECT_NEAR(report.at("measured").at("X").get<double>(), 2.1, 1e-9);
  EXPECT_NE(report.at("setup").get<std::string>().find("X = 2.6\n"), std::string::npos);
}

// HD-210: C+ and C-.
TEST_F(DncTouch, TouchesWithTheFourthAxis) {
  dnc.write("table.toml", "[probe]\nsurface = [ { axis = \"Y\", at = 20.0 } ]\n");
  const auto done =
      dnc({"touch", "surface", "--setup", "table.toml", "--datum", "5", "C-:40,0,-5,80", "--json"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto report = json::parse(done.out);
  EXPECT_NEAR(report.at("measured").at("C").get<double>(), 30, 1e-3);
  EXPECT_NE(report.at("setup").get<std::string>().find("\nC = 25"), std::string::npos);
  const auto other = dnc({"touch", "surface", "--setup", "table.toml", "A-:40,0,-5"});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("the fourth axis is C"), std::string::npos) << other.err;
}

TEST_F(DncTouch, RefusesTouchesThatMeasureSomethingElse) {
  dnc.write("plane.toml", "[probe]\nsurface = [ { axis = \"Y\", at = 20.0 } ]\n");
  const auto rotation = dnc({"touch", "rotation", "--setup", "plane.toml", "Y+:1,2,3", "X-:1,2,3"});
  EXPECT_EQ(rotation.status, 2);
  EXPECT_EQ(rotation.err, "dnc: touch 2 is X-: expected Y+, as the other touch of this side\n");
  const auto lying = dnc(
      {"touch", "rotation", "--tool-axis", "Y", "--setup", "plane.toml", "X+:1,2,3", "X+:1,5,3"});
  EXPECT_EQ(lying.status, 2);
  EXPECT_EQ(lying.err,
            "dnc: --tool-axis Y: a basic rotation rotates coordinates of the plane XY, across Z\n");
  const auto circle = dnc(
      {"touch", "circle", "--setup", "plane.toml", "X+:1,2,3", "X+:1,2,3", "X-:1,2,3", "X-:1,2,3"});
  EXPECT_EQ(circle.status, 2);
  const auto values =
      dnc({"touch", "surface", "--setup", "plane.toml", "--datum", "1,2", "Y+:1,2,3"});
  EXPECT_EQ(values.err, "dnc: --datum has 2 values, surface takes 1\n");
}

TEST_F(DncTouch, SaysWhatItCannotDo) {
  dnc.write("plane.toml", "[probe]\nsurface = [ { axis = \"Z\", at = -3.0 } ]\n");
  EXPECT_EQ(dnc({"touch", "surface", "--setup", "plane.toml", "Z-:1,2,10"}).status, 0);
  const auto far = dnc({"touch", "surface", "--setup", "plane.toml", "Z-:1,2,200"});
  EXPECT_EQ(far.status, 1);
  EXPECT_NE(far.err.find("TOUCH POINT INACCESSIBLE"), std::string::npos) << far.err;
  EXPECT_EQ(dnc({"touch", "corner", "--setup", "plane.toml", "Z-:1,2,10"}).status, 2);
  EXPECT_EQ(dnc({"touch", "surface", "--setup", "plane.toml", "down:1,2,10"}).status, 2);
}

TEST_F(DncTouch, MakesASetupOfAToolStore) {
  dnc.write("tools.h", "0 BEGIN PGM 0 INCH\nT9 SP12 L+1,5000 R+0,2500\n2 END PGM 0 INCH\n");
  const auto done = dnc({"setup", "import", "tools.h"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out,
            "units = \"mm\"\n\n[[tool]]\nnumber = 9\nlength = 38.1\nradius = 6.35\npocket = 12\n"
            "special = true\n");
  dnc.write("bad.h", "T9 P L+1\n");
  EXPECT_NE(dnc({"setup", "import", "bad.h"}).err.find("bad.h: line 1"), std::string::npos);
}

// HD-238: the touch probe came with software 06.
TEST_F(DncTouch, AsksForAControlWithATouchProbe) {
  const std::string probe = "[probe]\nsurface = [ { axis = \"Z\", at = -3.0 } ]\n[control]\n";
  dnc.write("old.toml", probe + "software = 5\n");
  dnc.write("new.toml", probe + "software = 6\n");
  dnc.write("wrong.toml", probe + "model = \"TNC 355\"\n");
  const auto touch = [&](const char* setup) {
    return dnc({"touch", "surface", "--setup", setup, "Z-:1,2,10"});
  };
  EXPECT_EQ(touch("new.toml").status, 0);
  const auto old = touch("old.toml");
  EXPECT_EQ(old.status, 2);
  EXPECT_EQ(old.out, "");
  EXPECT_NE(old.err.find("old.toml: a TNC 155 A with software 05 has no touch probe functions"),
            std::string::npos)
      << old.err;
  EXPECT_NE(touch("wrong.toml").err.find("wrong.toml: option model"), std::string::npos);
}

// HD-238
TEST_F(DncTouch, ImportsOnlyParametersThatTheControlHas) {
  dnc.write("mp.txt", "MP222: 168\nMP225: 7\n");
  dnc.write("tools.h", "T9 P12 L+1,5 R+0,25\n");
  dnc.write("old.toml", "[control]\nsoftware = 2\n");
  dnc.write("new.toml", "[control]\nsoftware = 3\n");
  EXPECT_EQ(dnc({"setup", "import", "mp.txt"}).out,
            "[control.machine_parameters]\nMP222 = 168\nMP225 = 7\n");
  EXPECT_EQ(dnc({"setup", "import", "mp.txt", "--setup", "new.toml"}).status, 0);
  const auto refused = dnc({"setup", "import", "mp.txt", "--setup", "old.toml"});
  EXPECT_NE(refused.status, 0);
  EXPECT_EQ(refused.out, "");
  EXPECT_NE(refused.err.find("mp.txt: line 2: MP225: a TNC 155 A with software 02 has no machine "
                             "parameters 225 to 234 (from software 03)"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(dnc({"setup", "import", "tools.h", "--setup", "new.toml"}).status, 0);
  const auto no_store = dnc({"setup", "import", "tools.h", "--setup", "old.toml"});
  EXPECT_NE(no_store.err.find("no central tool store"), std::string::npos) << no_store.err;
  EXPECT_NE(dnc({"setup", "import", "mp.txt", "--setup", "none.toml"}).status, 0);
}

}  // namespace
}  // namespace dripline
