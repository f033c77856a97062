#include "server/app/shared_settings.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "server/app/standby_faults.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::app {
namespace {

using Texts = std::vector<std::string>;

SettingsDifference difference_of(const Settings& own, const Settings& active) {
  return compare_settings(shared_settings(own), shared_settings(active));
}

TEST(SharedSettings, OfTwoServersAreAlikeThoughTheirAddressesAndFilesAreNot) {
  Settings own, active;
  own.http = "10.0.0.2:8430";
  own.state = "/var/lib/b";
  own.dds_port = 9000;
  const auto difference = difference_of(own, active);
  EXPECT_EQ(difference.forbids, Texts{});
  EXPECT_EQ(difference.others, Texts{});
}

TEST(SharedSettings, OfAnotherNetworkForbidATakeover) {
  Settings own, active;
  own.dds_domain = 7;
  own.dds_tag = "trial";
  active.dds_security = "/etc/dripline/pki";
  EXPECT_EQ(difference_of(own, active).forbids,
            (Texts{"dds-domain is 7, and 0 at the active server",
                   "dds-security is no, and yes at the active server",
                   "dds-tag is trial, and none at the active server"}));
}

/// Each server measures by its own: people think that both are the same.
TEST(SharedSettings, OfOtherTimesOfATakeoverAreNamed) {
  Settings own;
  own.takeover_s = 5;
  own.handover_s = 0;
  EXPECT_EQ(difference_of(own, {}).others, (Texts{"handover-s is 0, and 4 at the active server",
                                                  "takeover-s is 5, and 3 at the active server"}));
}

/// The same policy may be another file; a policy that is missing lets everything run.
TEST(SharedSettings, CompareThePolicyByItsText) {
  const test_support::TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
    return (folder.path() / name).string();
  };
  Settings own, active;
  active.policy = write("a.toml", "runs = \"release\"\n");
  own.policy = write("b.toml", "runs = \"release\"\n");
  EXPECT_EQ(difference_of(own, active).others, Texts{});
  own.policy = write("b.toml", "runs = \"open\"\n");
  EXPECT_EQ(difference_of(own, active).others.size(), 1u);
  own.policy = "";
  const auto others = difference_of(own, active).others;
  ASSERT_EQ(others.size(), 1u);
  EXPECT_TRUE(others[0].starts_with("policy is none, and sha256 ")) << others[0];
}

TEST(SharedSettings, NameWhatATakeoverWouldEnd) {
  Settings own, active;
  active.folders.resize(2);
  active.folders[0].name = "cam";
  active.folders[1].name = "archive";
  active.mqtt.broker = "mqtt://broker:1883";
  active.mqtt.host = "broker";
  active.mqtt.port = 1883;
  EXPECT_EQ(difference_of(own, active).others,
            (Texts{"folders is none, and archive, cam at the active server",
                   "mqtt is none, and broker:1883, prefix dripline at the active server"}));
}

TEST(SharedSettings, OfAnOlderServerAreNotKnown) {
  const auto difference = compare_settings(shared_settings({}), "");
  EXPECT_TRUE(difference.forbids.empty());
  EXPECT_TRUE(difference.others.empty());
}

TEST(StandbyFaults, KeepItFromWhatTheyConcern) {
  StandbyFaults faults;
  EXPECT_TRUE(faults.is_well());
  EXPECT_EQ(faults.summary(), "");
  faults.settings = "policy is none, and sha256 ab at the active server";
  EXPECT_FALSE(faults.is_well());
  EXPECT_FALSE(faults.is_unfit());
  EXPECT_EQ(faults.note(), faults.settings);
  EXPECT_EQ(faults.health()["reasons"].size(), 1u);
  EXPECT_EQ(faults.health().dump().find("sha256"), std::string::npos) << "for any client";
  faults.clock = "the clocks differ: this server's is 40 s late";
  EXPECT_FALSE(faults.is_unfit()) << "the machines are fed all the same";
  EXPECT_EQ(faults.note(), faults.settings + "; " + faults.clock);
  EXPECT_EQ(faults.summary(),
            ", its settings are not the active server's, its clock differs from the database's");
  faults.is_disk_full = true;
  EXPECT_TRUE(faults.is_unfit());
  EXPECT_FALSE(faults.is_blocked());
  faults.network = "dds-domain is 7, and 0 at the active server";
  EXPECT_TRUE(faults.is_blocked());
  EXPECT_EQ(faults.health()["status"], "degraded");
}

}  // namespace
}  // namespace dripline::app
