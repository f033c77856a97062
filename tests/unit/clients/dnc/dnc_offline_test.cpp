#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> objects;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) objects.push_back(json::parse(line));
  return objects;
}

class DncOffline : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};
};

TEST_F(DncOffline, TracesAProgramToItsEnd) {
  dnc.write("a.nc", "G20\nG0 X2 Z0.1\nG1 Z-1.5 F10\nM30\n");
  const auto result = dnc({"trace", "--control", "centurion", "a.nc"});
  EXPECT_EQ(result.status, 0) << result.err;
  const auto events = lines_of(result.out);
  ASSERT_GE(events.size(), 4u) << result.out;
  EXPECT_EQ(events.front().at("event"), "program");
  EXPECT_EQ(events.front().at("control"), "centurion");
  EXPECT_EQ(events.front().at("units"), "in");
  EXPECT_EQ(events[1],
            json::parse(R"({"event":"rapid","line":2,"block":null,"to":{"X":2,"Z":0.1}})"));
  EXPECT_EQ(events[2].at("to").at("Z"), -1.5);
  EXPECT_EQ(events.back().at("event"), "end");
}

TEST_F(DncOffline, ReadsAPunchedTapeAsTheTextItHolds) {
  const std::string text = "%\nN1X10000F500\nG01X20000\nG00Y5\nM30\n";
  dnc.write("a.nc", text);
  const auto trace = [&](const std::string& file) {
    return dnc({"trace", "--control", "tektronix-1704", file});
  };
  for (const std::string code : {"eia", "iso"}) {
    ASSERT_EQ(dnc({"convert", "a.nc", "-o", code, "--from", "ascii", "--to", code}).status, 0);
    EXPECT_EQ(trace(code).out, trace("a.nc").out) << code;
    EXPECT_EQ(trace(code).status, 0) << code;
  }
}

TEST_F(DncOffline, PrintsWhatAControlMakesOfAProgram) {
  dnc.write("a.pt", "PN1 G20 ;\nN1 G100 X15000 Y2. ;\n%\n");
  EXPECT_EQ(dnc({"trace", "--events", "a.pt"}).out,
            "PN1 G20 ;\r\nN001 G100 X1.5A Y2.A T1 ;\r\n%\r\n");
  dnc.write("a.nc", "G0 X1\n");
  const auto none = dnc({"trace", "--events", "--control", "centurion", "a.nc"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("centurion"), std::string::npos) << none.err;
}

TEST_F(DncOffline, ForecastsBlocksThatStarve) {
  dnc.write("a.nc", "%\nF2000G01X1000\nX2000Y1\nG00X3000Y2\nM30\n");
  const auto result =
      dnc({"forecast", "--control", "tektronix-1704", "--line", "tektronix1704", "--json", "a.nc"});
  EXPECT_EQ(result.status, 1) << result.err;
  const auto report = json::parse(result.out);
  EXPECT_EQ(report.at("starved"), 2);
  EXPECT_EQ(report.at("worst").at(0).at("line"), 3);
  EXPECT_NEAR(report.at("worst").at(0).at("feed_that_would_do").get<double>(), 138.5, 0.1);
  EXPECT_EQ(dnc({"forecast", "--control", "tektronix-1704", "--cps", "5000", "a.nc"}).status, 0);
  EXPECT_EQ(dnc({"forecast", "--control", "tektronix-1704", "a.nc"}).status, 2);
}

TEST_F(DncOffline, CutsAnArcIntoLines) {
  const auto result =
      dnc({"approximate", "--radius", "2", "--sweep", "90", "--tolerance", "0.2", "--blocks"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "G01X14142Y14142\nX0Y20000\n");
  EXPECT_EQ(dnc({"approximate", "--radius", "2", "--tolerance", "0"}).status, 2);
}

TEST_F(DncOffline, EndsATraceWithTheAlarm) {
  dnc.write("a.nc", "G0 X1\nGOTO 77\nM30\n");
  const auto result = dnc({"trace", "--control", "centurion", "a.nc"});
  EXPECT_EQ(result.status, 1);
  const auto events = lines_of(result.out);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().at("event"), "alarm") << result.out;
  EXPECT_EQ(events.back().at("line"), 2);
}

TEST_F(DncOffline, ChecksAProgram) {
  dnc.write("a.nc", "G20\nG0 X2 Z0.1\nG1 Z-1.5 F10\nM30\n");
  const auto text = dnc({"check", "--control", "centurion", "a.nc"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("a.nc: reaches its end"), std::string::npos) << text.out;
  EXPECT_EQ(text.err, "");
  const auto report = json::parse(dnc({"check", "--control", "centurion", "a.nc", "--json"}).out);
  EXPECT_EQ(report.at("ended"), true);
  EXPECT_EQ(report.at("blocks"), 4);
  EXPECT_EQ(report.at("extents").at("Z").at("min"), -1.5);
  EXPECT_EQ(report.at("extents").at("X").at("max"), 2);
}

TEST_F(DncOffline, ChecksWithAnAlarmExitWithOne) {
  dnc.write("a.nc", "G0 X1\nGOTO 77\nM30\n");
  const auto result = dnc({"check", "--control", "centurion", "a.nc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(result.out.starts_with("a.nc:2")) << result.out;
}

TEST_F(DncOffline, TakesProbesAndAnswersFromTheSetup) {
  dnc.write("a.nc", "INPUT (DIAMETER)P1\nX[P1]\nPROBE1 Z-6\nM30\n");
  dnc.write(
      "lathe.toml",
      "units = \"in\"\nanswers = [\"3.5\"]\n[probe]\nsurface = [ { axis = \"Z\", at = -0.5 } ]\n");
  const auto result = dnc({"trace", "--control", "centurion", "--setup", "lathe.toml", "a.nc"});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  bool has_prompt = false, has_probe = false;
  for (const auto& event : lines_of(result.out)) {
    if (event.at("event") == "prompt") has_prompt = event.at("answer") == "3.5";
    if (event.at("event") == "probe") has_probe = event.at("result").at("at").at("Z") == -0.5;
  }
  EXPECT_TRUE(has_prompt) << result.out;
  EXPECT_TRUE(has_probe) << result.out;
}

TEST_F(DncOffline, LooksForCalledProgramsInTheSetupsLibrary) {
  dnc.write("a.nc", "G0 X1\nM98 P2\nM30\n");
  dnc.write("setups/subs/O0002.nc", "G0 Z7\nM99\n");
  dnc.write("setups/lathe.toml", "[library]\npath = \"subs/\"\n");
  const auto result =
      dnc({"trace", "--control", "centurion", "--setup", "setups/lathe.toml", "a.nc"});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("\"Z\":7"), std::string::npos) << result.out;
}

struct RefusalCase {
  const char* name;
  std::vector<std::string> arguments;
  const char* says;
};

class DncOfflineRefusal : public testing::TestWithParam<RefusalCase> {};

TEST_P(DncOfflineRefusal, ExitsWithTwo) {
  const Dnc dnc(DNC_PATH);
  dnc.write("a.nc", "G0 X1\nM30\n");
  dnc.write("ask.nc", "INPUT (DIAMETER)P1\nM30\n");
  dnc.write("riddle.txt", "hello world\n");
  dnc.write("wrong.toml", "color = 1\n");
  for (const char* verb : {"check", "trace"}) {
    std::vector<std::string> arguments{verb};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    const auto result = dnc(arguments);
    EXPECT_EQ(result.status, 2) << verb << result.out;
    EXPECT_NE(result.err.find(GetParam().says), std::string::npos) << verb << result.err;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , DncOfflineRefusal,
    testing::Values(
        RefusalCase{"no_file", {}, "FILE is required"},
        RefusalCase{"missing_file", {"no.nc"}, "no.nc cannot be read"},
        RefusalCase{"folder", {"."}, "not a regular file"},
        RefusalCase{"unknown_control", {"--control", "abacus", "a.nc"}, "abacus"},
        RefusalCase{"no_telling", {"riddle.txt"}, "--control with one of"},
        RefusalCase{
            "missing_setup", {"--control", "centurion", "--setup", "no.toml", "a.nc"}, "no.toml"},
        RefusalCase{
            "unknown_key", {"--control", "centurion", "--setup", "wrong.toml", "a.nc"}, "color"},
        RefusalCase{"no_answer_left", {"--control", "centurion", "ask.nc"}, "DIAMETER"}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline
