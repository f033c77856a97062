#include "server/app/settings.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cstdlib>
#include <fstream>

#include "protocol/base/private_folder.hpp"
#include "server/app/server.hpp"
#include "server/app/state_folder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::app {
namespace {

CommandLine read(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "dncd");
  return read_command_line(static_cast<int>(arguments.size()), arguments.data());
}

TEST(Settings, HaveDefaultsAndComeFromTheCommandLine) {
  const auto line = read({"--dds-domain", "7", "--http", "127.0.0.1:0"});
  EXPECT_EQ(line.print, "");
  EXPECT_EQ(line.settings.dds_domain, 7u);
  EXPECT_EQ(line.settings.http, "127.0.0.1:0");
  EXPECT_EQ(line.settings.lease_ms, 2000u);
  EXPECT_EQ(line.settings.state,
            default_state_folder(process_environment, ::geteuid() == 0).value());
}

TEST(Settings, FindTheStateFolderWhereDncLooksForIt) {
  ::setenv("DRIPLINE_STATE", "/named/by/all", 1);
  EXPECT_EQ(read({}).settings.state, "/named/by/all");
  EXPECT_EQ(read({"--state", "/given"}).settings.state, "/given");
  ::unsetenv("DRIPLINE_STATE");
}

TEST(Settings, OfTheCommandLineWinOverTheFile) {
  const test_support::TemporaryFolder folder;
  const auto path = folder.path() / "dncd.toml";
  std::ofstream(path) << "dds-domain = 3\ndds-tag = \"shop\"\n";
  const auto line = read({"--config", path.c_str(), "--dds-domain", "7"});
  EXPECT_EQ(line.settings.dds_domain, 7u);
  EXPECT_EQ(line.settings.dds_tag, "shop");
}

/// An empty variable of a script must not start a server in place of a migration.
TEST(Settings, ThatAreEmptyOnTheCommandLineAreAnErrorWhereTheyNameADatabase) {
  for (const char* name : {"--migrate-to", "--store"}) {
    const auto line = read({name, ""});
    EXPECT_EQ(line.exit_code, 2) << name;
    EXPECT_NE(line.print.find(std::string(name) + ": a value is needed"), std::string::npos)
        << line.print;
  }
  EXPECT_EQ(read({"--store", "", "--migrate-to", "/state"}).exit_code, 2);
  EXPECT_EQ(read({"--store", "postgresql://db-1/shop", "--migrate-to", "/state"}).print, "");
}

TEST(Settings, OfAFileAreCheckedByKeyTypeAndRange) {
  Settings settings;
  const auto says = [&](const char* toml) {
    const auto applied = apply_toml(settings, toml);
    return applied ? std::string("taken") : applied.error().what;
  };
  EXPECT_EQ(says("\nlease-ms = 500"), "taken");
  EXPECT_NE(says("\ncolor = 1").find("line 2: key 'color' is not known"), std::string::npos);
  EXPECT_NE(says("lease-ms = \"x\"").find("whole number"), std::string::npos);
  EXPECT_NE(says("http = 1").find("must be a string"), std::string::npos);
  EXPECT_NE(says("dds-domain = 231").find("0 to 230"), std::string::npos);
  EXPECT_NE(says("dds-domain = ").find("line 1"), std::string::npos);
}

TEST(Settings, OfAFileMayHoldSerialPorts) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "rules.toml") << "reply = \"O9998\"\n";
  const auto path = folder.path() / "dncd.toml";
  std::ofstream(path) << R"(
[[port]]
machine = "mill-3"
address = "/dev/ttyUSB0"
template = "tnc155"
rules_file = "rules.toml"
baud = 4800
wait_for_xon = true
[[port]]
name = "com2"
machine = "lathe"
address = "tcp://10.0.0.7:4001"
enabled = false
)";
  const auto line = read({"--config", path.c_str()});
  ASSERT_EQ(line.print, "");
  ASSERT_EQ(line.settings.ports.size(), 2u);
  const auto& mill = line.settings.ports[0];
  EXPECT_EQ(mill.name, "mill-3");
  EXPECT_EQ(mill.line_template, "tnc155");
  EXPECT_EQ(mill.rules, "reply = \"O9998\"\n");
  ASSERT_EQ(mill.settings.size(), 2u);
  EXPECT_EQ(mill.settings[0], std::pair(std::string("baud"), std::string("4800")));
  EXPECT_EQ(mill.settings[1].second, "yes");
  EXPECT_FALSE(line.settings.ports[1].is_enabled);
}

TEST(Settings, OfAPortAreRefusedWithLineAndKey) {
  Settings settings;
  const auto says = [&](const char* toml) {
    const auto applied = apply_toml(settings, toml);
    return applied ? std::string("taken") : applied.error().what;
  };
  EXPECT_NE(says("port = 3").find("write [[port]]"), std::string::npos);
  EXPECT_NE(says("[[port]]\nmachine = \"a\"").find("address"), std::string::npos);
  EXPECT_NE(says("[[port]]\nmachine = 3").find("line 2: machine"), std::string::npos);
  EXPECT_NE(says("[[port]]\nbaud = []").find("line 2: baud"), std::string::npos);
  EXPECT_NE(says("[[port]]\nrules_file = \"/nowhere\"").find("/nowhere"), std::string::npos);
}

TEST(Settings, WithWrongUseEndWithTwo) {
  EXPECT_EQ(read({"--color"}).exit_code, 2);
  EXPECT_EQ(read({"--dds-domain", "231"}).exit_code, 2);
  EXPECT_EQ(read({"--config", "/nowhere/dncd.toml"}).exit_code, 2);
  const auto help = read({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* option : {"--state",
                             "--http",
                             "--tls-certificate",
                             "--tls-key",
                             "--http-connections",
                             "--http-connections-per-address",
                             "--http-event-streams",
                             "--mtconnect",
                             "--mtconnect-open-network",
                             "--dds-domain",
                             "--dds-tag",
                             "--dds-interface",
                             "--dds-open-network",
                             "--discovery-interval-ms",
                             "--lease-ms",
                             "--log",
                             "--log-level",
                             "--log-mb",
                             "--log-files",
                             "--config",
                             "--begin-empty",
                             "--recover-admin"}) {
    EXPECT_NE(help.print.find(option), std::string::npos) << option;
  }
}

TEST(Settings, TextOfADatabaseElsewhereIsKeptHereUnlessItIsSwitchedOff) {
  EXPECT_EQ(read({}).settings.program_cache_mb, 4096u);
  EXPECT_EQ(read({"--program-cache-mb", "0"}).settings.program_cache_mb, 0u);
  EXPECT_EQ(read({"--program-cache-mb", "4000001"}).exit_code, 2);
}

TEST(Settings, AStandbyIsAskedFor) {
  EXPECT_FALSE(read({}).settings.standby);
  EXPECT_EQ(read({}).settings.takeover_s, 3u);
  const auto asked =
      read({"--standby", "yes", "--takeover-s", "10", "--dds-port", "9000"}).settings;
  EXPECT_TRUE(asked.standby);
  EXPECT_EQ(asked.takeover_s, 10u);
  EXPECT_EQ(asked.dds_port, 9000u);
  EXPECT_EQ(read({"--takeover-s", "1"}).exit_code, 2);
  EXPECT_EQ(read({}).settings.handover_s, 4u);
  EXPECT_EQ(read({"--handover-s", "0"}).settings.handover_s, 0u) << "never";
  EXPECT_EQ(read({"--dds-port", "65536"}).exit_code, 2);
}

TEST(StateFolder, KnowsTheTermOfADatabaseThatWasMovedHere) {
  const test_support::TemporaryFolder parent;
  const auto folder = StateFolder::open(parent.path() / "state");
  ASSERT_TRUE(folder) << folder.error().what;
  EXPECT_EQ(folder->term(), 0u);
  ASSERT_TRUE(folder->remember_term(1795900000));
  EXPECT_EQ(folder->term(), 1795900000u);
  std::ofstream(parent.path() / "state" / "term") << "abc";
  EXPECT_EQ(folder->term().error().code, Errc::Corrupt);
}

TEST(StateFolder, MakesATokenOnceForItsOwnerAlone) {
  const test_support::TemporaryFolder parent;
  const auto folder = StateFolder::open(parent.path() / "a" / "state");
  ASSERT_TRUE(folder) << folder.error().what;
  const auto token = folder->token();
  ASSERT_TRUE(token);
  EXPECT_EQ(token->size(), 64u);
  EXPECT_EQ(folder->token().value(), *token);
  struct stat facts {};
  ASSERT_EQ(::stat(folder->token_file().c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777u, 0600u);
  std::filesystem::permissions(folder->token_file(), std::filesystem::perms{0644});
  EXPECT_EQ(folder->token().error().code, Errc::Denied);
}

TEST(StateFolder, RefusesAnEmptyToken) {
  const test_support::TemporaryFolder parent;
  const auto folder = StateFolder::open(parent.path());
  std::ofstream(folder->token_file()).flush();
  std::filesystem::permissions(folder->token_file(), std::filesystem::perms{0600});
  EXPECT_EQ(folder->token().error().code, Errc::Denied);
}

TEST(Server, IsNotStartedWithUnsafeSettings) {
  const test_support::TemporaryFolder folder;
  const SystemClock clock;
  Settings settings;
  settings.state = folder.path() / "state";
  settings.http = "0.0.0.0:0";
  EXPECT_EQ(Server::start(settings, clock).error().code, Errc::Denied);
  settings.http = "127.0.0.1:0";
  settings.tls_key = "key.pem";
  EXPECT_EQ(Server::start(settings, clock).error().code, Errc::Denied);
  EXPECT_FALSE(std::filesystem::exists(settings.state));
}

TEST(Settings, AnMtConnectAgentBeyondThisComputerMustBeConfirmed) {
  EXPECT_TRUE(read({"--mtconnect-open-network", "yes"}).settings.mtconnect_open_network);
  const test_support::TemporaryFolder folder;
  const SystemClock clock;
  Settings settings;
  settings.state = folder.path() / "state";
  settings.http = "127.0.0.1:0";
  for (const char* address : {"0.0.0.0:5000", "[::]:5000", "5000", "localhost"}) {
    settings.mtconnect = address;
    EXPECT_EQ(Server::start(settings, clock).error().code, Errc::Denied) << address;
  }
  EXPECT_FALSE(std::filesystem::exists(settings.state)) << "nothing was made";
}

TEST(Settings, OfAnOpenNetworkMustBeConfirmed) {
  EXPECT_TRUE(read({"--dds-open-network", "yes"}).settings.dds_open_network);
  EXPECT_EQ(read({"--dds-open-network", "perhaps"}).exit_code, 2);
  const test_support::TemporaryFolder folder;
  const SystemClock clock;
  Settings settings;
  settings.state = folder.path() / "state";
  settings.http = "127.0.0.1:0";
  settings.dds_interface = "eth0";
  const auto refused = Server::start(settings, clock);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Denied);
  EXPECT_FALSE(std::filesystem::exists(settings.state)) << "nothing was made";
}

TEST(StateFolder, KnowsItsDatabase) {
  const test_support::TemporaryFolder place;
  const auto folder = StateFolder::open(place.path() / "state").value();
  EXPECT_TRUE(folder.expect_database(false)) << "a new folder";
  std::ofstream(folder.database()) << "database";
  EXPECT_TRUE(folder.remember_database("1234", "db"));
  EXPECT_TRUE(folder.expect_database(false));
  EXPECT_TRUE(folder.remember_database("1234", "db"));
  EXPECT_EQ(folder.remember_database("5678", "db").error().code, Errc::Corrupt);
  EXPECT_EQ(folder.expect_database(true).error().code, Errc::Busy);
  std::filesystem::remove(folder.database());
  std::ofstream(folder.database().string() + "-wal") << "left over";
  EXPECT_EQ(folder.expect_database(false).error().code, Errc::Corrupt);
  EXPECT_TRUE(folder.expect_database(true));
  EXPECT_FALSE(std::filesystem::exists(folder.database().string() + "-wal"));
  EXPECT_TRUE(folder.remember_database("5678", "db"));
}

}  // namespace
}  // namespace dripline::app
