#include <gtest/gtest.h>
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

/// What `dnc setup` shows and changes of a TNC.
namespace dripline {
namespace {

using nlohmann::json;
using test_support::FakeServer;
using test_support::run_json;
using test_support::setup_json;

constexpr const char* kSetupPath = "/api/v1/machines/mill-3/setup";

const std::string kSetup = R"(# mill-3, Fräsmaschine
[control]
central_tool_file = true
random_changer = true
magazine_pockets = 20
position_display = "DIST"
display_size = "large"
block_increment = 5
baud_rate = 4800
limit_high = { X = 500.0 }
nc_software = "227 020 08"
machine_parameters = { MP71 = 515, MP80 = 2 }
[[control.user_parameters]]
parameter = 80
text = "FEED LIMIT"
value = 2      # in steps
min = -1
max = 8
[[control.user_parameters]]
parameter = 173
value = 1
[[tool]]
number = 1
pocket = 4     # the long one
[[tool]]
number = 2
pocket = 9
[[tool]]
number = 3
)";

/// One blank between words, as columns are as wide as what they hold.
std::string squeezed(const std::string& text) {
  std::string squeezed;
  for (const char c : text) {
    if (c != ' ' || (!squeezed.empty() && squeezed.back() != ' ')) squeezed += c;
  }
  return squeezed;
}

class DncSetup : public testing::Test {
 protected:
  DncSetup() {
    dnc.environment["DRIPLINE_SERVER"] = server.url();
    dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
    set_control("tnc155");
    server.set_answer(std::string("GET ") + kSetupPath, setup_json("mill-3", kSetup));
    json saved = setup_json("mill-3", "");
    saved["revision"] = 5;
    server.set_answer(std::string("PUT ") + kSetupPath, 201, saved.dump());
  }
  void set_control(const std::string& control) {
    json machine = test_support::machine_json("mill-3");
    machine["control"] = control;
    server.set_machine(machine);
  }
  /// What was put, path and text; empty when nothing was.
  std::pair<std::string, std::string> put() const {
    for (const std::string& call : server.calls()) {
      if (!call.starts_with("PUT ")) continue;
      const std::size_t blank = call.find(' ', 4);
      return {call.substr(4, blank - 4), call.substr(blank + 1)};
    }
    return {};
  }
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  /// A run of mill-3 that began with setup 4, and its report.
  void set_run(const std::string& state, const json& setup, const std::vector<std::string>& lines) {
    json run = run_json("aa11", state);
    run["machine"] = "mill-3";
    run["setup"] = setup;
    server.set_run(run);
    json records = json::array();
    for (const std::string& line : lines) {
      records.push_back({{"machine", "mill-3"},
                         {"epoch", 1},
                         {"number", records.size() + 1},
                         {"time", "2026-11-21T07:41:00Z"},
                         {"run", "aa11"},
                         {"kind", "output"},
                         {"block", 1},
                         {"line", 1},
                         {"sequence", nullptr},
                         {"device", "screen"},
                         {"text", line}});
    }
    server.set_answer("GET /api/v1/runs/aa11/records", {{"records", records}});
  }
  FakeServer server;
  test_support::Dnc dnc{DNC_PATH};
};

// HD-081, HD-082, HD-083, HD-085, HD-086, HD-087: the control's order, values and ranges.
TEST_F(DncSetup, ShowsTheModFunctionsOfATnc) {
  const auto shown = dnc({"setup", "show", "mill-3"});
  ASSERT_EQ(shown.status, 0) << shown.err;
  const std::string shown_text = squeezed(shown.out);
  std::size_t at = 0;
  for (const char* line :
       {"MOD FUNCTION VALUE ALLOWED", "VACANT BLOCKS 3100 of 3100", "CHANGE MM/INCH mm mm, inch",
        "POSITION DATA DIST ACTL, REF, LAG, NOML, DIST",
        "POSITION DISPLAY large small, large (not in ISO)", "BLOCK NUMBER INCREMENT 5 0 to 99",
        "BAUD RATE 4800 110, 150, 300, 600, 1200, 2400, 4800, 9600",
        "LIMIT X+ +500.000 mm -30000.000 mm to +30000.000 mm", "LIMIT X- off", "LIMIT IV- off",
        "NC SOFTWARE NUMBER 227 020 08", "PLC SOFTWARE NUMBER -", "USER PARAMETERS 2 at most 16",
        "CODE NUMBER", "NO USER PARAMETER MP VALUE ALLOWED", "1 FEED LIMIT MP80 2 -1 to 8",
        "2 USER PAR. 2 MP173 1"}) {
    const std::size_t found = shown_text.find(line, at);
    EXPECT_NE(found, std::string::npos) << line << "\n" << shown.out;
    if (found != std::string::npos) at = found;
  }
  const auto data = json::parse(dnc({"setup", "show", "mill-3", "--json"}).out);
  EXPECT_EQ(data.at("revision"), 4);
  EXPECT_EQ(data.at("mod_functions").at(2), json::parse(R"({"name":"POSITION DATA","value":"DIST",
                            "range":"ACTL, REF, LAG, NOML, DIST"})"));
  EXPECT_EQ(data.at("user_parameters").at(0),
            json::parse(R"({"number":1,"text":"FEED LIMIT","machine_parameter":80,"value":2.0,
                            "min":-1.0,"max":8.0})"));
}

// HD-081, HD-052: what is left of the memory beside the programs it has.
TEST_F(DncSetup, CountsVacantBlocks) {
  server.add_program("15.h", "0 BEGIN PGM 15 MM\n1 L X+1 R0 F100\n2 END PGM 15 MM\n");
  server.add_program("16.h", "0 BEGIN PGM 16 MM\n1 END PGM 16 MM\n");
  const auto shown = dnc({"setup", "show", "mill-3", "--holds", "15.h", "--holds", "16.h"});
  EXPECT_NE(squeezed(shown.out).find("VACANT BLOCKS 3095 "), std::string::npos) << shown.out;
  server.add_program("bad.h", "G0 X1\n");
  const auto bad = dnc({"setup", "show", "mill-3", "--holds", "bad.h"});
  EXPECT_EQ(bad.status, 1);
  EXPECT_TRUE(bad.err.starts_with("dnc: bad.h: ")) << bad.err;
}

// HD-081: the baud rate of the menu beside that of the line.
TEST_F(DncSetup, ItsBaudRateIsComparedWithThatOfThePort) {
  json port = test_support::port_json("line-3");
  port["machine"] = "mill-3";
  port["effective"]["baud"] = "2400";
  server.set_answer("GET /api/v1/ports/line-3", port);
  const std::string warning =
      "The setup of mill-3 has 4800 baud for the control, and the line has 2400.\n";
  EXPECT_TRUE(dnc({"port", "show", "line-3"}).out.ends_with(warning));
  EXPECT_EQ(json::parse(dnc({"port", "show", "line-3", "--json"}).out).at("control_baud_rate"),
            4800);
  port["effective"]["baud"] = "4800";
  server.set_answer("GET /api/v1/ports/line-3", port);
  EXPECT_EQ(dnc({"port", "show", "line-3"}).out.find("The setup of"), std::string::npos);
}

TEST_F(DncSetup, OtherControlsHaveNoMenu) {
  set_control("fanuc");
  server.set_answer(std::string("GET ") + kSetupPath,
                    setup_json("mill-3", "[[tool]]\nnumber = 1\n"));
  EXPECT_EQ(dnc({"setup", "show", "mill-3"}).out.find("MOD FUNCTION"), std::string::npos);
  EXPECT_FALSE(
      json::parse(dnc({"setup", "show", "mill-3", "--json"}).out).contains("mod_functions"));
  EXPECT_EQ(dnc({"setup", "show", "mill-3", "--holds", "15.h"}).err,
            "dnc: --holds is for a TNC; machine mill-3 is fanuc\n");
}

// HD-086: a new version, in which nothing else has changed.
TEST_F(DncSetup, SetsAUserParameter) {
  const auto set = dnc({"setup", "parameter", "mill-3", "FEED LIMIT", "-1"});
  EXPECT_EQ(set.status, 0) << set.err;
  EXPECT_TRUE(set.out.starts_with("Saved setup 5 of mill-3")) << set.out;
  EXPECT_EQ(put().first, std::string(kSetupPath) +
                             "?comment=FEED%20LIMIT%20%28MP80%29%20-1%2C%20before%202&base=4");
  EXPECT_EQ(put().second, with(with(kSetup, "value = 2 ", "value = -1 "), "MP80 = 2", "MP80 = -1"));
}

TEST_F(DncSetup, SetsAUserParameterByItsNumbers) {
  EXPECT_EQ(dnc({"setup", "parameter", "mill-3", "2", "7.5", "-m", "why"}).status, 0);
  EXPECT_EQ(put().first, std::string(kSetupPath) + "?comment=why&base=4");
  EXPECT_EQ(put().second, with(kSetup, "value = 1\n", "value = 7.5\n"));
}

struct RefusedParameter {
  const char* name;
  std::vector<std::string> arguments;
  std::string error;
  int status = 1;
};
class DncSetupRefuses : public DncSetup, public testing::WithParamInterface<RefusedParameter> {};

// HD-086
TEST_P(DncSetupRefuses, WhatIsNoUserParameterOrOutOfRange) {
  std::vector<std::string> arguments{"setup", "parameter", "mill-3"};
  for (const auto& argument : GetParam().arguments) arguments.push_back(argument);
  const auto refused = dnc(arguments);
  EXPECT_EQ(refused.status, GetParam().status);
  EXPECT_EQ(refused.err, "dnc: " + GetParam().error + "\n");
  EXPECT_EQ(put().first, "") << "nothing is changed";
}

INSTANTIATE_TEST_SUITE_P(
    , DncSetupRefuses,
    testing::Values(
        RefusedParameter{"a_machine_parameter",
                         {"MP71", "1"},
                         "machine mill-3: 'MP71' is no user parameter; there are: 1 FEED LIMIT "
                         "(MP80), 2 USER PAR. 2 (MP173)"},
        RefusedParameter{"out_of_range",
                         {"FEED LIMIT", "9"},
                         "machine mill-3: FEED LIMIT (MP80): 9 is not -1 to 8"},
        RefusedParameter{"no_number", {"1", "much"}, "'much' is not a number", 2}),
    [](const auto& i) { return std::string(i.param.name); });

TEST_F(DncSetup, DoesNotGoOverWhatSomebodyElseHasStored) {
  server.set_answer(std::string("PUT ") + kSetupPath, 409,
                    R"({"error":{"code":"conflict","message":"made from 4, and 5 is newer"}})");
  const auto late = dnc({"setup", "parameter", "mill-3", "1", "3"});
  EXPECT_EQ(late.status, 1);
  EXPECT_EQ(late.err, "dnc: made from 4, and 5 is newer\n");
  dnc.write("a.toml", kSetup);
  EXPECT_EQ(dnc({"setup", "push", "mill-3", "a.toml", "--base", "4"}).status, 1);
  EXPECT_EQ(server.calls().back().substr(0, 42), "PUT /api/v1/machines/mill-3/setup?base=4 #");
}

// HD-069: the last line about a tool is where it is.
TEST_F(DncSetup, TakesOverThePocketsOfTheNewestRun) {
  set_run("completed", 4,
          {"T1 P0", "T1 P9", "T2 P0", "T1 P9", "T2 P0", "T3 P", "T77 P3", "PART 5 DONE"});
  const auto taken = dnc({"setup", "pockets", "mill-3"});
  EXPECT_EQ(taken.status, 0) << taken.err;
  EXPECT_EQ(put().first, std::string(kSetupPath) + "?comment=pockets%20after%20run%20aa11&base=4");
  EXPECT_EQ(put().second,
            with(with(kSetup, "pocket = 9\n", "pocket = 0\n"), "pocket = 4 ", "pocket = 9 "));
}

// HD-069
TEST_F(DncSetup, TakesOverWhatARunHadChangedWhenItWasCutOff) {
  set_run("interrupted", 4, {"T1 P0"});
  EXPECT_EQ(dnc({"setup", "pockets", "mill-3"}).status, 0);
  EXPECT_EQ(put().second, with(kSetup, "pocket = 4 ", "pocket = 0 "));
}

// HD-069
TEST_F(DncSetup, LeavesPocketsAloneWhereTheyMayBeWrong) {
  const auto refusal = [&] {
    const auto refused = dnc({"setup", "pockets", "mill-3"});
    EXPECT_EQ(refused.status, 1) << refused.out;
    EXPECT_EQ(put().first, "");
    return refused.err;
  };
  EXPECT_EQ(refusal(), "dnc: machine mill-3 has finished no run\n");
  set_run("active", 4, {"T1 P0"});
  EXPECT_EQ(refusal(),
            "dnc: machine mill-3: run aa11 is active: its pockets are known when it has ended\n");
  set_run("completed", 3, {"T1 P0"});
  EXPECT_EQ(
      refusal(),
      "dnc: run aa11 of mill-3 began with setup 3, and 4 is the newest by now: its pockets are "
      "not taken over\n");
  set_run("completed", 4, {"PART 5 DONE"});
  EXPECT_EQ(refusal(),
            "dnc: run aa11 of mill-3 has reported no pockets: a control on a line does not; dnc "
            "setup import takes its program 0\n");
  set_run("completed", nullptr, {"T1 P0"});
  EXPECT_EQ(refusal(), "dnc: run aa11 of mill-3 began without a setup of the server\n");
  server.set_answer(
      std::string("GET ") + kSetupPath,
      setup_json("mill-3", with(kSetup, "random_changer = true", "random_changer = false")));
  EXPECT_EQ(refusal(),
            "dnc: setup 4 of mill-3 has no random changer (random_changer): its pockets do not "
            "change\n");
}

TEST(DncSetupOptions, ListTheKeysOfAControlWithoutAServer) {
  const test_support::Dnc dnc(DNC_PATH);
  const auto listed = dnc({"setup", "options", "rs274ngc"});
  EXPECT_EQ(listed.status, 0) << listed.err;
  const std::string text = squeezed(listed.out);
  EXPECT_NE(text.find("KEY VALUE DEFAULT MEANING"), std::string::npos);
  EXPECT_NE(text.find("profile nist, linuxcnc nist which language programs are in"),
            std::string::npos);
  EXPECT_NE(text.find("slots whole number, 1 to 99999 128 "), std::string::npos);
  EXPECT_EQ(text.find("custom_g"), std::string::npos);

  const auto unknown = dnc({"setup", "options", "mazak"});
  EXPECT_NE(unknown.status, 0);
  EXPECT_NE(unknown.err.find("\"mazak\" is not known"), std::string::npos) << unknown.err;
}

TEST(DncSetupOptions, GiveEveryControlAsJson) {
  const test_support::Dnc dnc(DNC_PATH);
  const auto all = json::parse(dnc({"setup", "options", "--json"}).out).at("controls");
  ASSERT_EQ(all.size(), 8U);
  for (const json& control : all) {
    for (const json& option : control.at("options")) {
      for (const char* member : {"key", "type", "default", "text"}) {
        EXPECT_FALSE(option.at(member).get<std::string>().empty()) << option;
      }
    }
  }
  const auto fanuc =
      json::parse(dnc({"setup", "options", "fanuc", "--json"}).out).at("controls").at(0);
  EXPECT_EQ(fanuc.at("control"), "fanuc");
  const json depth = {{"key", "max_call_depth"}, {"type", "whole number"},
                      {"range", "1 to 16"},      {"unit", ""},
                      {"default", "4"},          {"text", "calls within calls"}};
  const auto& options = fanuc.at("options");
  EXPECT_NE(std::find(options.begin(), options.end(), depth), options.end());
}

/// DRIPLINE_ACCEPT=1 rewrites the page.
TEST(DncSetupOptions, AreTheReferenceOfTheDocuments) {
  const test_support::Dnc dnc(DNC_PATH);
  const auto written = dnc({"setup", "options", "--markdown"});
  ASSERT_EQ(written.status, 0) << written.err;
  if (std::getenv("DRIPLINE_ACCEPT") != nullptr) {
    std::ofstream(OPTIONS_PAGE) << written.out;
    GTEST_SKIP() << "rewritten: " << OPTIONS_PAGE;
  }
  std::ifstream file(OPTIONS_PAGE);
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(page, written.out) << OPTIONS_PAGE << " is not up to date: run with DRIPLINE_ACCEPT=1";
}

}  // namespace
}  // namespace dripline
