// `dnc pki`: the shop's own authority, from the keys to a revoked machine.
#include <gtest/gtest.h>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>

#include "protocol/dds/security_folder.hpp"
#include "tests/unit/clients/dnc/dnc_process.hpp"

namespace dripline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test_support::DncResult;

class DncPki : public testing::Test {
 protected:
  DncResult pki(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "pki");
    arguments.insert(arguments.end(), {"--folder", (dnc.folder() / "shop").string()});
    return dnc(arguments);
  }
  void expect_good(const DncResult& result, const std::string& part) const {
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  }
  void expect_refused(const DncResult& result, int status, const std::string& part) const {
    EXPECT_EQ(result.status, status) << result.out;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  }
  json listed() const {
    const auto result = pki({"list", "--json"});
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(result.out);
  }
  Result<dds::SecurityFolder> verified(const std::string& machine) const {
    return dds::open_security_folder(dnc.folder() / "shop/gateways" / machine,
                                     {.role = dds::Role::Gateway, .machine = machine},
                                     SystemClock().now());
  }

  test_support::Dnc dnc{DNC_PATH};
};

TEST_F(DncPki, MakesAnAuthorityAndSaysWhichFolderGoesWhere) {
  expect_good(pki({"init", "--shop", "Example Shop"}), "stay on this computer");
  expect_refused(pki({"init"}), 1, "there is an authority");
  expect_good(pki({"server"}), "Copy this folder to the server's computer");
  const auto gateway = pki({"gateway", "lathe-1", "--days", "100"});
  expect_good(gateway, "dds-security = \"/etc/dripline/dds/lathe-1\"");
  EXPECT_NE(gateway.out.find((dnc.folder() / "shop/gateways/lathe-1").string()), std::string::npos);
  const auto opened = verified("lathe-1");
  ASSERT_TRUE(opened) << opened.error().what;
  EXPECT_EQ(opened->certificate.subject, "CN=lathe-1,OU=gateway,O=Example Shop");
  expect_refused(pki({"gateway", "lathe-1"}), 1, "renew or revoke it");
}

TEST_F(DncPki, ListsRenewsAndRevokes) {
  expect_good(pki({"init"}), "");
  expect_good(pki({"server"}), "");
  expect_good(pki({"gateway", "lathe-1", "--days", "20"}), "");
  expect_good(pki({"gateway", "mill-2"}), "");
  const auto before = listed();
  ASSERT_EQ(before["certificates"].size(), 3U);
  EXPECT_EQ(before["certificates"][0]["role"], "server");
  EXPECT_EQ(before["certificates"][1]["name"], "lathe-1");
  EXPECT_EQ(before["certificates"][1]["state"], "renew it");
  EXPECT_EQ(before["certificates"][2]["state"], "valid");
  expect_good(pki({"list"}), "lathe-1");

  expect_good(pki({"renew", "lathe-1"}), "restart dncgw@lathe-1");
  EXPECT_EQ(listed()["certificates"][1]["state"], "valid");
  EXPECT_NE(listed()["certificates"][1]["serial"], before["certificates"][1]["serial"]);
  expect_good(pki({"renew", "--server"}), "restart dncd");

  expect_good(pki({"revoke", "mill-2"}), "revoked.pem");
  EXPECT_EQ(listed()["certificates"][2]["state"], "revoked");
  EXPECT_NE(listed()["certificates"][2]["revoked"], nullptr);
  EXPECT_FALSE(fs::exists(dnc.folder() / "shop/gateways/mill-2"));
  expect_refused(pki({"renew", "mill-2"}), 1, "was revoked");
  expect_good(pki({"gateway", "mill-2"}), "");
}

TEST_F(DncPki, RefusesWhatItCannotDo) {
  expect_refused(pki({"server"}), 1, "dnc pki init");
  expect_refused(pki({"init", "--shop", "a<b>"}), 2, "name of the shop");
  expect_good(pki({"init"}), "");
  expect_refused(pki({"gateway", "../x"}), 2, "machine name");
  expect_refused(pki({"gateway", "Lathe"}), 2, "machine name");
  expect_refused(pki({"gateway", "lathe-1", "--days", "0"}), 2, "--days");
  expect_refused(pki({"renew", "lathe-1"}), 1, "no certificate");
  expect_refused(pki({"revoke"}), 2, "name a machine, or --server");
  expect_refused(pki({"renew", "lathe-1", "--server"}), 2, "name a machine, or --server");
}

/// A kill leaves the folder of before or the one of after, and the next call continues.
TEST_F(DncPki, LeavesNoHalfFolderWhenItIsKilled) {
  expect_good(pki({"init"}), "");
  expect_good(pki({"gateway", "lathe-1"}), "");
  std::mt19937 random(7);
  constexpr int kKills = 40;
  int killed = 0;
  for (int i = 0; i < kKills; ++i) {
    auto process =
        dnc.start({"pki", "renew", "lathe-1", "--folder", (dnc.folder() / "shop").string()});
    const auto wait = std::chrono::microseconds(random() % 20'000);
    if (!process.wait(std::chrono::duration_cast<std::chrono::milliseconds>(wait))) ++killed;
    process.kill();
    const auto opened = verified("lathe-1");
    ASSERT_TRUE(opened) << opened.error().what;
  }
  EXPECT_GT(killed, kKills / 4);
  expect_good(pki({"renew", "lathe-1"}), "");
  EXPECT_EQ(listed()["certificates"][0]["serial"], verified("lathe-1").value().certificate.serial);
  expect_good(pki({"revoke", "lathe-1"}), "");
}

}  // namespace
}  // namespace dripline
