// The files below deploy/examples are what users begin with: they must be taken as they are.
#include <gtest/gtest.h>
#include <fstream>
#include <sstream>

#include "gateway/line/inbound/rule_reader.hpp"
#include "server/app/settings.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/release_policy.hpp"
#include "server/ports/port_settings.hpp"

namespace dripline {
namespace {

std::string read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Examples, PortsAreTakenByTheServersSettingsAndFitTheirTemplates) {
  app::Settings settings;
  const auto taken =
      app::apply_toml(settings, read("deploy/examples/ports.toml"), "deploy/examples");
  ASSERT_TRUE(taken) << taken.error().what;
  ASSERT_EQ(settings.ports.size(), 3u);
  for (const auto& port : settings.ports) {
    const auto line = ports::effective_settings(port);
    EXPECT_TRUE(line) << port.name << ": " << line.error().what;
    const auto rules = line::read_rules(port.rules);
    EXPECT_TRUE(rules) << port.name << ": " << rules.error().what;
  }
  EXPECT_EQ(wire::short_form(ports::effective_settings(settings.ports[1]).value()), "9600e71");
}

TEST(Examples, ThePolicyIsTaken) {
  const auto policy = library::ReleasePolicy::parse(read("deploy/examples/policy.toml"));
  ASSERT_TRUE(policy) << policy.error().what;
  EXPECT_TRUE(policy->runs_released_only);
  EXPECT_TRUE(policy->rule(storage::RevisionStep::Approve).needs_four_eyes);
}

TEST(Examples, HotFoldersAreTakenByTheServersSettings) {
  app::Settings settings;
  const auto taken = app::apply_toml(settings, read("deploy/examples/folders.toml"));
  ASSERT_TRUE(taken) << taken.error().what;
  ASSERT_EQ(settings.folders.size(), 1u);
  EXPECT_EQ(settings.folders[0].rules.size(), 3u);
  const auto broken = app::apply_toml(settings, "[[folder]]\nname='a'\npath='relative'\n");
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().what.find("line 3"), std::string::npos) << broken.error().what;
}

TEST(Examples, TheBrokerIsTakenByTheServersSettings) {
  app::Settings settings;
  const auto taken = app::apply_toml(settings, read("deploy/examples/mqtt.toml"));
  ASSERT_TRUE(taken) << taken.error().what;
  EXPECT_EQ(settings.mqtt.broker, "mqtts://broker.example:8883");
  EXPECT_EQ(settings.mqtt.prefix, "plant/hall-2");
  const auto broken = app::apply_toml(settings, "[mqtt]\nbroker='mqtt://a'\nqso=1\n");
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().what.find("line 3"), std::string::npos) << broken.error().what;
}

TEST(Examples, BaudOfAPortOverridesItsLine) {
  app::Settings settings;
  const auto taken = app::apply_toml(
      settings, "[[port]]\nmachine='m'\naddress='/dev/x'\nbaud=4800\nline='9600e72'\n");
  ASSERT_TRUE(taken) << taken.error().what;
  const auto line = ports::effective_settings(settings.ports.at(0));
  EXPECT_EQ(wire::short_form(line.value()), "4800e72");
}

// HD-217: a port with a TNC's template has the rates of its MOD function.
TEST(Ports, OfATncHaveItsEightRates) {
  storage::Port port;
  port.name = "line-1";
  port.line_template = "tnc155-bcc";
  for (const char* baud : {"110", "150", "300", "600", "1200", "2400", "4800", "9600"}) {
    port.settings = {{"baud", baud}};
    EXPECT_TRUE(ports::effective_settings(port)) << baud;
  }
  port.settings = {{"line", "19200e71"}};
  EXPECT_EQ(ports::effective_settings(port).error().what,
            "port 'line-1': baud 19200: a TNC 151/155 has 110, 150, 300, 600, 1200, 2400, 4800, "
            "9600");
  port.line_template = "plain";
  EXPECT_TRUE(ports::effective_settings(port)) << "other controls of the family are quicker";
}

TEST(Examples, RulesDoWhatTheirCommentsDescribe) {
  const auto rules = line::read_rules(read("deploy/examples/rules.toml"));
  ASSERT_TRUE(rules) << rules.error().what;
  const auto verdict = [&](const std::string& text) {
    const auto found = rules->explain(text);
    return found.action + " " + found.argument;
  };
  EXPECT_EQ(verdict("%\nO9999\n(PRG=0042)\nM30\n%\n"), "send O0042");
  EXPECT_TRUE(verdict("%\nO9999\n(DIR=)\nM30\n%\n").starts_with("directory"));
  EXPECT_TRUE(verdict("%\nO9999\n(BLOCK=N1200)\nM30\n%\n").starts_with("restart"));
  EXPECT_TRUE(verdict("PROBE X1.5\n").starts_with("report"));
}

// HD-081, HD-086: every option of the control is in it.
TEST(Examples, SetupOfATncIsTaken) {
  const std::string text = read("deploy/examples/tnc155.toml");
  ASSERT_FALSE(text.empty());
  const auto taken = library::DialectCatalog().check_setup("tnc155", text);
  EXPECT_TRUE(taken) << taken.error().what;
}

}  // namespace
}  // namespace dripline
