// `dnc port parameters`: on files, and against a fake server.
#include <gtest/gtest.h>

#include "tests/unit/clients/dnc/dnc_process.hpp"
#include "tests/unit/clients/support/fake_server.hpp"
#include "tests/unit/clients/support/server_json.hpp"

// Rows: HD-217 (baud rates), HD-218 (MP 222), HD-232 (MP 218 to 224).
namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;
using test_support::FakeServer;

class DncPortParameters : public testing::Test {
 protected:
  template <class... More>
  auto parameters(More... more) {
    return dnc({"port", "parameters", more...});
  }
  Dnc dnc{DNC_PATH};
};

TEST_F(DncPortParameters, GoFromALineToTheControlAndBack) {
  const auto list = parameters("--for", "tnc155-bcc", "--set", "4800o81", "--set", "tnc_heading=H");
  ASSERT_EQ(list.status, 0) << list.err;
  EXPECT_EQ(list.out,
            "MP71: 515\r\nMP218: 17736\r\nMP219: 16712\r\nMP220: 279\r\nMP221: 5382\r\n"
            "MP222: 185\r\nMP223: 1\r\nMP224: 4\r\n");
  dnc.write("mp.txt", list.out);
  const auto line = parameters("mp.txt", "--baud", "4800");
  EXPECT_EQ(line.out, "--template tnc155-bcc baud=4800 data_bits=8 parity=odd tnc_heading=H\n")
      << line.err;
}

TEST_F(DncPortParameters, TakeTheLettersOfHeadingsFromTheSetup) {
  dnc.write("mill.toml", "[control.machine_parameters]\nMP223 = 1\nMP218 = 17736\nMP219 = 16712\n");
  EXPECT_EQ(parameters("mill.toml").out, "--template tnc155-bcc tnc_heading=H\n");
  dnc.write("mill.toml",
            "[control]\nheading_letter = \"%\"\n[control.machine_parameters]\nMP223 = 1\n"
            "MP218 = 17736\nMP219 = 16712\n");
  EXPECT_EQ(parameters("mill.toml").out, "--template tnc155-bcc\n");
  dnc.write("mill.toml", "[control]\nheading_letter = \"H\"\nmachine_parameters = { MP223 = 1 }\n");
  EXPECT_EQ(parameters("mill.toml").out, "--template tnc155-bcc tnc_heading=H\n");
}

TEST_F(DncPortParameters, NameWhatNoLineHas) {
  EXPECT_EQ(parameters("--for", "19200e71", "--set", "flow=heidenhain").err,
            "dnc: baud 19200: a TNC 151/155 has 110, 150, 300, 600, 1200, 2400, 4800, 9600\n");
  EXPECT_EQ(parameters("--for", "centurion").status, 2);
  dnc.write("mp.txt", "MP222: 300\r\n");
  EXPECT_EQ(parameters("mp.txt").err, "dnc: MP222 = 300: expected a whole number from 0 to 255\n");
  dnc.write("mp.txt", "MP222: 168\r\nMP\r\n");
  EXPECT_NE(parameters("mp.txt").err.find("mp.txt: line 2"), std::string::npos);
  dnc.write("lathe.toml", "[control]\nm6_pin = 3\n");
  EXPECT_NE(parameters("lathe.toml").err.find("lathe.toml: the setup has nothing of a TNC's"),
            std::string::npos);
  EXPECT_EQ(parameters().status, 2);
}

class DncPortAgainstParameters : public DncPortParameters {
 protected:
  DncPortAgainstParameters() {
    dnc.environment["DRIPLINE_SERVER"] = server.url();
    dnc.environment["DRIPLINE_TOKEN"] = FakeServer::kToken;
    auto port = test_support::port_json("line-1");
    port["effective"] = {{"line", "2400e71"}, {"flow", "heidenhain"}, {"baud", "2400"},
                         {"data_bits", "7"},  {"parity", "even"},     {"stop_bits", "1"},
                         {"tnc_etx", "ETX"},  {"tnc_eot", "EOT"},     {"tnc_ack", "BEL"}};
    server.set_answer("GET /api/v1/ports/line-1", port);
  }
  void serve_setup(const std::string& text) {
    server.set_answer("GET /api/v1/machines/mill-3/setup", {{"machine", "mill-3"},
                                                            {"revision", 3},
                                                            {"size", text.size()},
                                                            {"sha256", std::string(64, 'a')},
                                                            {"comment", nullptr},
                                                            {"author", "test"},
                                                            {"created", "2026-11-21T07:40:06Z"},
                                                            {"text", text}});
  }
  FakeServer server;
};

TEST_F(DncPortAgainstParameters, FindNoDifferenceWhereThereIsNone) {
  serve_setup("[control]\nmachine_parameters = { MP71 = 515, MP222 = 168, MP223 = 0 }\n");
  const auto fits = parameters("--port", "line-1");
  EXPECT_EQ(fits.status, 0) << fits.err;
  EXPECT_EQ(fits.out, "Port line-1 matches its control's parameters.\n");
}

TEST_F(DncPortAgainstParameters, NameTheMachineWhoseSetupSaysNothing) {
  serve_setup("[[tool]]\nnumber = 1\nlength = 5\n");
  const auto silent = parameters("--port", "line-1");
  EXPECT_EQ(silent.status, 2);
  EXPECT_EQ(silent.err.find("dnc: setup of mill-3: the setup has nothing"), 0u) << silent.err;
}

TEST_F(DncPortAgainstParameters, SayWhatThePortHasOtherwise) {
  serve_setup("[control]\nbaud_rate = 9600\nmachine_parameters = { MP222 = 169, MP223 = 1 }\n");
  const auto differs = parameters("--port", "line-1");
  EXPECT_EQ(differs.status, 1) << differs.err;
  EXPECT_EQ(differs.out,
            "baud: the port has 2400, the control 9600\n"
            "data_bits: the port has 7, the control 8\n"
            "flow: the port has heidenhain, the control heidenhain_bcc\n"
            "tnc_ack: the port has BEL, the control ACK\n");
  dnc.write("mine.toml", "[control]\nmachine_parameters = { MP222 = 184 }\n");
  const auto other = parameters("mine.toml", "--port", "line-1", "--json");
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(
      json::parse(other.out),
      (json{{"port", "line-1"},
            {"differences", {{{"setting", "parity"}, {"port", "even"}, {"control", "odd"}}}}}));
}

}  // namespace
}  // namespace dripline
