#include "protocol/process/settings_reader.hpp"

#include <gtest/gtest.h>
#include <array>
#include <CLI/CLI.hpp>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::process {
namespace {

struct Network {
  std::string tag = "shop";
  std::uint32_t lease_ms = 2000;
};
struct Options {
  Network network;
  std::optional<bool> unattended;
  std::filesystem::path state;
  std::string speed = "1x", changes;
};

constexpr std::array kRows{
    SettingRow<Options>{"tag", "text", "", "", "keeps systems apart",
                        text_value<&Options::network, &Network::tag>()},
    SettingRow<Options>{"lease-ms", "number", "ms", "", "ends a silent connection",
                        number_value<100, 600'000, &Options::network, &Network::lease_ms>()},
    SettingRow<Options>{"unattended", "yes|no", "", "yes; with a line no", "allows a remote start",
                        yes_no_value<&Options::unattended>()},
    SettingRow<Options>{"state", "folder", "", "(required)", "keeps the records",
                        text_value<&Options::state>()},
    SettingRow<Options>{"speed",
                        "factor",
                        "",
                        "",
                        "sets the pace",
                        {Written::TextOrNumber,
                         [](Options& options, std::string_view text) -> Result<void> {
                           options.speed = text;
                           return {};
                         },
                         [](const Options& options) { return options.speed; }}},
    SettingRow<Options>{"change",
                        "key=value",
                        "",
                        "(none)",
                        "changes the line",
                        {Written::List,
                         [](Options& options, std::string_view text) -> Result<void> {
                           options.changes = text;
                           return {};
                         },
                         nullptr}},
};
constexpr std::span<const SettingRow<Options>> kTable = kRows;

/// What a file does to the options; its error, or "".
std::string read(Options& options, std::string_view toml, SettingsReader::Others others = {}) {
  const SettingsReader reader(kTable, options);
  const auto done = reader.read_toml(toml, others);
  return done ? "" : done.error().what;
}

TEST(SettingsReader, SetsEveryTypeFromAFile) {
  Options options;
  EXPECT_EQ(read(options,
                 "tag = 'hall'\nlease-ms = 500\nunattended = 'no'\nstate = '/s'\nspeed = 100\n"
                 "change = ['baud=9600', 'parity=even']\n"),
            "");
  EXPECT_EQ(options.network.tag, "hall");
  EXPECT_EQ(options.network.lease_ms, 500U);
  EXPECT_EQ(options.unattended, false);
  EXPECT_EQ(options.state, "/s");
  EXPECT_EQ(options.speed, "100");
  EXPECT_EQ(options.changes, "baud=9600\nparity=even\n");
}

TEST(SettingsReader, NamesLineAndKeyOfAWrongValue) {
  Options options;
  EXPECT_EQ(read(options, "\ncolor = 1"), "line 2: key 'color' is not known");
  EXPECT_EQ(read(options, "tag = 1"), "line 1: tag must be a string, not another type");
  EXPECT_EQ(read(options, "tag = ['a']"), "line 1: tag must be a string, not a list");
  EXPECT_EQ(read(options, "lease-ms = 'x'"), "line 1: lease-ms must be a whole number");
  EXPECT_EQ(read(options, "\n\nlease-ms = 99"), "line 3: lease-ms: 99 is not from 100 to 600000");
  EXPECT_EQ(read(options, "lease-ms = -1"),
            "line 1: lease-ms: '-1' is not a whole number from 100 to 600000");
  EXPECT_EQ(read(options, "unattended = 'perhaps'"),
            "line 1: unattended: 'perhaps' is neither yes nor no");
  EXPECT_EQ(read(options, "tag = ").substr(0, 7), "line 1:");
  EXPECT_EQ(options.network.lease_ms, 2000U);
}

TEST(SettingsReader, LeavesOnlyNamedKeysToItsCaller) {
  Options options;
  EXPECT_EQ(read(options, "tag = 'hall'\n[[port]]\nname = 'a'\n", {"port"}), "");
  EXPECT_EQ(options.network.tag, "hall");
  EXPECT_EQ(read(options, "[[port]]\nname = 'a'\n"), "line 1: key 'port' is not known");
  EXPECT_EQ(read(options, "ports = 1", {"port"}), "line 1: key 'ports' is not known");
}

TEST(SettingsReader, LetsTheCommandLineWinOverTheFile) {
  const test_support::TemporaryFolder folder;
  const auto path = folder.path() / "daemon.toml";
  std::ofstream(path) << "lease-ms = 300\ntag = 'file'\n";
  Options options;
  SettingsReader reader(kTable, options);
  CLI::App app;
  reader.declare(app);
  app.parse("--lease-ms 700 --change baud=9600 --change parity=even");
  ASSERT_TRUE(reader.read_file(path));
  ASSERT_TRUE(reader.apply_command_line());
  EXPECT_EQ(options.network.lease_ms, 700U);
  EXPECT_EQ(options.network.tag, "file");
  EXPECT_EQ(options.changes, "baud=9600\nparity=even");
}

TEST(SettingsReader, NamesTheOptionOfAWrongValue) {
  Options options;
  SettingsReader reader(kTable, options);
  CLI::App app;
  reader.declare(app);
  app.parse("--lease-ms 7");
  const auto done = reader.apply_command_line();
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().what, "--lease-ms: 7 is not from 100 to 600000");
  EXPECT_EQ(reader.read_file("/nowhere/daemon.toml").error().what,
            "configuration file '/nowhere/daemon.toml' cannot be read");
}

TEST(SettingsReader, ShowsTypeUnitAndDefaultInTheHelp) {
  Options options;
  options.network.lease_ms = 1500;
  SettingsReader reader(kTable, options);
  CLI::App app;
  reader.declare(app);
  const std::string help = app.help();
  EXPECT_NE(help.find("--lease-ms number"), std::string::npos) << help;
  EXPECT_NE(help.find("ends a silent connection [1500 ms]"), std::string::npos) << help;
  EXPECT_NE(help.find("allows a remote start [yes; with a line no]"), std::string::npos) << help;
}

}  // namespace
}  // namespace dripline::process
