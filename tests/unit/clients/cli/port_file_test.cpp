#include "clients/cli/port/port_file.hpp"

#include <gtest/gtest.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::cli {
namespace {

class PortFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const auto path = folder_.path() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  void expect_refused(const std::string& text, const std::string& says) {
    const auto ports = read_port_file(write("ports.toml", text));
    ASSERT_FALSE(ports);
    EXPECT_NE(ports.error().what.find(says), std::string::npos) << ports.error().what;
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(PortFile, GivesPortsWithTheirSettingsAndRules) {
  write("rules.toml", "reply = \"O9998\"\n");
  const auto ports = read_port_file(write("ports.toml", R"(
[[port]]
name = "line-1"
machine = "mill-3"
address = "/dev/ttyUSB0"
template = "tnc155"
rules_file = "rules.toml"
baud = 4800
wait_for_xon = true
reader_cps = 1.5
eob = "lf"

[[port]]
machine = "lathe-1"
address = "tcp://10.0.0.9:4001"
enabled = false
)"));
  ASSERT_TRUE(ports) << ports.error().what;
  ASSERT_EQ(ports->size(), 2u);
  EXPECT_EQ(ports->at(0).line_template, "tnc155");
  EXPECT_EQ(ports->at(0).rules, "reply = \"O9998\"\n");
  EXPECT_EQ(ports->at(0).settings,
            (client::Settings{
                {"baud", "4800"}, {"eob", "lf"}, {"reader_cps", "1.5"}, {"wait_for_xon", "yes"}}));
  EXPECT_TRUE(ports->at(0).enabled);
  EXPECT_EQ(ports->at(1).name, "lathe-1") << "of its machine";
  EXPECT_EQ(ports->at(1).address, "tcp://10.0.0.9:4001");
  EXPECT_FALSE(ports->at(1).enabled);
}

TEST_F(PortFile, SaysWhereItIsWrong) {
  expect_refused("[[port]]\nname = \"a\"\n", "needs a machine and an address");
  expect_refused("[[port]]\nname = 1\n", "line 2: name must be a string");
  expect_refused("[[port]]\nenabled = \"no\"\n", "enabled must be true or false");
  expect_refused("[[port]]\nbaud = [9600]\n", "line 2: baud must be a string, a number");
  expect_refused("[[port]]\nrules_file = \"none.toml\"\n", "none.toml");
  expect_refused("port = [1]\n", "write [[port]]");
  expect_refused("[port]\n", "write [[port]]");
  expect_refused("\n", "has no [[port]]");
  expect_refused("[[port", "line 1");
}

TEST_F(PortFile, BoundsWhatItReads) {
  const auto big = write("big.toml", std::string(2000, '#'));
  const auto refused = read_small_file(big, 1999);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::LimitExceeded);
  EXPECT_NE(refused.error().what.find("2000 bytes: at most 1999"), std::string::npos);
  EXPECT_TRUE(read_small_file(big, 2000));
}

TEST(PortSetting, IsAKeyWithAValueOrALine) {
  client::Settings settings;
  EXPECT_TRUE(apply_setting(settings, "eob=lf"));
  EXPECT_TRUE(apply_setting(settings, "end_char==")) << "the value may be =";
  EXPECT_TRUE(apply_setting(settings, "57600n81"));
  EXPECT_EQ(settings, (client::Settings{{"eob", "lf"}, {"end_char", "="}, {"line", "57600n81"}}));
  EXPECT_TRUE(apply_setting(settings, "eob="));
  EXPECT_FALSE(settings.contains("eob"));
  EXPECT_FALSE(apply_setting(settings, "=4800"));
  EXPECT_FALSE(apply_setting(settings, "fast"));
  EXPECT_FALSE(apply_setting(settings, ""));
}

TEST(PortSetting, OfALineTakesAwayWhatStoodOverIt) {
  client::Settings settings{{"baud", "300"}, {"parity", "odd"}, {"flow", "none"}};
  EXPECT_TRUE(apply_setting(settings, "9600e72"));
  EXPECT_EQ(settings, (client::Settings{{"flow", "none"}, {"line", "9600e72"}}));
  EXPECT_TRUE(apply_setting(settings, "baud=4800"));
  EXPECT_TRUE(apply_setting(settings, "line=2400e71"));
  EXPECT_EQ(settings, (client::Settings{{"flow", "none"}, {"line", "2400e71"}}));
}

}  // namespace
}  // namespace dripline::cli
