// `dnc check --stops`, and whose file `dnc check`, `forecast` and `graphics` name for a called
// program.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;

constexpr const char* kMain =
    "0 BEGIN PGM 1 MM\n"
    "1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n"
    "2 BLK FORM 0.2 X+100 Y+80 Z+0\n"
    "3 TOOL DEF 1 L+0 R+5\n"
    "4 TOOL CALL 1 Z S500\n"
    "5 STOP M05\n"
    "6 LBL 1\n"
    "7 L X+20 Y+40 Z+5 R0 F9999 M03\n"
    "8 L Z-4 R F100 M00\n"
    "9 CALL LBL 1 REP 2/2\n"
    "10 L X+30 R F M06\n"
    "11 CALL PGM 2\n"
    "12 L Z+5 R F9999 M02\n"
    "13 END PGM 1 MM\n";
constexpr const char* kCalled = "0 BEGIN PGM 2 MM\n1 L X+80\n2 STOP\n3 END PGM 2 MM\n";
/// Alarms in its third line.
constexpr const char* kWrong = "0 BEGIN PGM 2 MM\n1 L X+80\n2 L Q+1\n3 END PGM 2 MM\n";

class DncCheck : public testing::Test {
 protected:
  DncCheck() {
    dnc.write("1.h", kMain);
    dnc.write("2.h", kCalled);
  }
  test_support::Dnc dnc{DNC_PATH};
};

// HD-197: STOP and M00 stop, M06 does where the machine has no changer; M02 ends.
TEST_F(DncCheck, ListsTheStopsOfAProgramAndOfThoseItCalls) {
  const auto checked = dnc({"check", "--stops", "1.h"});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_TRUE(checked.out.starts_with(
      "1.h:6: stop: program stop, block 5: 5 STOP M05\n"
      "1.h:9: stop: program stop, block 8, met 3 times: 8 L Z-4 R F100 M00\n"
      "2.h:3: stop: program stop, block 2: 2 STOP\n"
      "1.h: reaches its end\n"))
      << checked.out;
  EXPECT_NE(checked.out.find("stops       5\n"), std::string::npos) << checked.out;
  const auto plain = dnc({"check", "1.h"});
  EXPECT_EQ(plain.out.find("stop:"), std::string::npos) << plain.out;
}

// HD-197: the machine builder decides whether M06 stops.
TEST_F(DncCheck, ListsStopsAsJsonAndAsTheSetupHasThem) {
  dnc.write("by_hand.toml", "[control]\nm06_stop = true\n");
  const auto checked = dnc({"check", "--stops", "--setup", "by_hand.toml", "--json", "1.h"});
  const auto report = json::parse(checked.out);
  EXPECT_EQ(report.at("stop_count"), 6);
  ASSERT_EQ(report.at("stops").size(), 4u) << checked.out;
  EXPECT_EQ(report.at("stops").at(1), json::parse(R"({"file":"1.h","line":9,"block":8,
      "kind":"program","text":"8 L Z-4 R F100 M00","times":3})"));
  EXPECT_EQ(report.at("stops").at(2), json::parse(R"({"file":"1.h","line":11,"block":10,
      "kind":"tool_change","text":"10 L X+30 R F M06","times":1})"));
  EXPECT_EQ(report.at("stops").at(3).at("file"), "2.h");
  EXPECT_FALSE(json::parse(dnc({"check", "--json", "1.h"}).out).contains("stops"));
}

// HD-196, HD-197
TEST_F(DncCheck, ListsTheStopsUpToABlock) {
  const auto report = json::parse(dnc({"check", "--stops", "--to", "8", "--json", "1.h"}).out);
  EXPECT_EQ(report.at("stopped").at("block"), 8);
  EXPECT_EQ(report.at("stop_count"), 2);
  EXPECT_EQ(report.at("stops").at(1).at("times"), 1);
}

// HD-197: in the ISO form, and of a control of another maker.
TEST_F(DncCheck, ListsTheStopsOfEveryControl) {
  dnc.write("3.i", "%3 G71 *\nN1 G38 *\nN9999 %3 G71 *\n");
  const auto iso = dnc({"check", "--stops", "3.i"});
  EXPECT_TRUE(iso.out.starts_with("3.i:2: stop: program stop, block 1: N1 G38 *\n")) << iso.out;
  dnc.write("shaft.nc", "G0 X1\nN20 M0\nM98 P5\nM30\n");
  dnc.write("O0005.nc", "Z2\nM0\nM99\n");
  const auto lathe = dnc({"check", "--stops", "--control", "centurion", "shaft.nc"});
  EXPECT_TRUE(
      lathe.out.starts_with("shaft.nc:2: stop: program stop, block 20: N20 M0\n"
                            "O0005.nc:2: stop: program stop: M0\n"))
      << lathe.out;
}

TEST_F(DncCheck, NamesTheCalledProgramThatAlarms) {
  dnc.write("subs/2.h", kWrong);
  dnc.write("lib.toml", "[library]\npath = \"subs\"\n");
  const auto checked = dnc({"check", "--setup", "lib.toml", "1.h"});
  EXPECT_EQ(checked.status, 1);
  EXPECT_TRUE(checked.out.starts_with("subs/2.h:3:6: alarm TNC-BLOCK-FORMAT: ")) << checked.out;
  EXPECT_NE(checked.out.find("\n1.h: raises an alarm in line 3 of subs/2.h\n"), std::string::npos)
      << checked.out;
  const auto report = json::parse(dnc({"check", "--setup", "lib.toml", "--json", "1.h"}).out);
  EXPECT_EQ(report.at("alarm").at("file"), "subs/2.h");
  EXPECT_EQ(report.at("alarm").at("line"), 3);
}

// A short feed of a called program starves, the helix of one is not drawn.
TEST_F(DncCheck, ForecastAndGraphicsNameTheFileOfWhatTheyList) {
  dnc.write("m.nc", "G21 G91 G94\nG1 X5 F100\nM98 P5\nN20 G1 X5 (a long comment here)\nM30\n");
  dnc.write("O0005.nc", "G1 X0.01 F9000 M99\n");
  const auto forecast = dnc({"forecast", "--control", "fanuc", "--cps", "10", "m.nc"});
  EXPECT_NE(forecast.out.find("\nO0005.nc:1 "), std::string::npos) << forecast.out << forecast.err;
  const auto listed = dnc({"forecast", "--control", "fanuc", "--cps", "10", "--json", "m.nc"});
  const auto worst = json::parse(listed.out).at("worst");
  ASSERT_EQ(worst.size(), 2u) << listed.out;
  EXPECT_EQ(worst.at(0).at("file"), "O0005.nc");
  EXPECT_EQ(worst.at(1).at("file"), "m.nc");
  dnc.write("2.h",
            "0 BEGIN PGM 2 MM\n1 CC X+40 Y+40\n2 CP IPA+360 IZ-2 DR+ R F100\n3 END PGM 2 MM\n");
  const auto drawn = dnc({"graphics", "1.h"});
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(drawn.err.find("PGM-SECTION CANNOT BE SHOWN: line 3 of 2.h, "), std::string::npos)
      << drawn.err;
  const auto shown = json::parse(dnc({"graphics", "--json", "1.h"}).out);
  EXPECT_EQ(shown.at("omitted").at(0).at("file"), "2.h");
}

TEST_F(DncCheck, ForecastAndGraphicsNameItToo) {
  dnc.write("2.h", kWrong);
  const auto forecast = dnc({"forecast", "--cps", "5000", "1.h"});
  EXPECT_NE(forecast.status, 0);
  EXPECT_TRUE(forecast.err.starts_with("dnc: the program alarms in line 3 of 2.h: "))
      << forecast.err;
  const auto drawn = dnc({"graphics", "1.h"});
  EXPECT_EQ(drawn.status, 1);
  EXPECT_TRUE(drawn.err.starts_with("dnc: the program alarms in line 3 of 2.h: ")) << drawn.err;
  dnc.write("shaft.nc", "P156=50\nP157=20\nG0 X1\nM98 P5\nM30\n");
  dnc.write("O0005.nc", "Z2\nGOTO 77\nM99\n");
  const auto turned = dnc({"graphics", "--control", "centurion", "shaft.nc"});
  EXPECT_EQ(turned.status, 1);
  EXPECT_NE(turned.err.find("dnc: the program alarms in line 2 of O0005.nc: "), std::string::npos)
      << turned.err;
  dnc.write("1.h", "0 BEGIN PGM 1 MM\n1 STOP\n2 L Q+1\n");
  EXPECT_TRUE(dnc({"forecast", "--cps", "5000", "1.h"})
                  .err.starts_with("dnc: the program alarms in line 3: "));
}

}  // namespace
}  // namespace dripline
