// Users, tokens and groups of machines with the real programs: `dnc` as its users type it.
#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using test_support::Finished;

class Identity : public testing::Test {
 protected:
  Identity() { system.start_server(); }

  /// As a person in a shop: with a home of her own, and the server's address.
  Finished as(const std::string& home, const std::string& arguments,
              const std::string& typed = "") {
    const std::string command =
        "printf '%s\\n' '" + typed +
        "' | env -u DRIPLINE_TOKEN -u XDG_CONFIG_HOME HOME=" + (system.folder() / home).string() +
        " " + program_path("dnc") + " --server " + system.url() + " " + arguments;
    return test_support::run_to_end({"/bin/sh", "-c", command}, system.folder() / "dnc.out");
  }
  /// As the owner of the state folder, who is asked for nothing.
  Finished admin(const std::string& arguments, const std::string& typed = "") {
    const std::string command = "printf '%s\\n' '" + typed + "' | " + program_path("dnc") +
                                " --state " + system.server_state().string() + " " + arguments;
    return test_support::run_to_end({"/bin/sh", "-c", command}, system.folder() / "dnc.out");
  }
  void expect_good(const Finished& done) { EXPECT_EQ(done.status, 0) << done.output; }
  void expect_denied(const Finished& done, const std::string& part) {
    EXPECT_EQ(done.status, 4) << done.output;
    EXPECT_NE(done.output.find(part), std::string::npos) << done.output;
  }
  void restart_server() {
    system.server().signal(15);
    EXPECT_EQ(system.server().wait(), 0);
    system.start_server();
  }
  nlohmann::json whoami(const std::string& home) {
    return nlohmann::json::parse(as(home, "whoami --json").output, nullptr, false);
  }

  System system;
};

TEST_F(Identity, TheAuditTrailIsVerifiedHereAndElsewhere) {
  const std::string kept = (system.folder() / "kept.txt").string();
  const std::string trail = (system.folder() / "trail.txt").string();
  expect_good(admin("user add anna --role viewer --group all"));
  expect_good(admin("audit checkpoint > " + kept));
  expect_good(admin("user add bert --role viewer --group all"));
  restart_server();
  expect_good(admin("audit verify"));
  expect_good(admin("audit verify --checkpoint " + kept));
  expect_good(admin("audit export " + trail));
  const auto offline = "audit verify " + trail + " --checkpoint " + kept;
  const auto good = as("stranger", offline);
  EXPECT_EQ(good.status, 0) << good.output;
  EXPECT_NE(good.output.find("each as it was written"), std::string::npos) << good.output;

  system.server().signal(15);
  EXPECT_EQ(system.server().wait(), 0);
  const auto changed = test_support::run_to_end(
      {"/usr/bin/sqlite3", (system.server_state() / "dripline.sqlite").string(),
       "UPDATE audit SET subject = 'carl' WHERE subject = 'bert'"},
      system.folder() / "sqlite.out");
  ASSERT_EQ(changed.status, 0) << changed.output;
  system.start_server();
  const auto found = admin("audit verify");
  EXPECT_EQ(found.status, 1) << found.output;
  EXPECT_NE(found.output.find("the audit trail was changed: entry"), std::string::npos)
      << found.output;
  EXPECT_EQ(system.rest().get("/api/v1/health").json()["status"], "degraded");
  expect_good(admin("audit export " + trail));
  const auto elsewhere = as("stranger", offline);
  EXPECT_EQ(elsewhere.status, 1) << elsewhere.output;
}

TEST_F(Identity, TheFirstStartMakesOneAdministratorWhomDncFinds) {
  const auto token = system.server_state() / "token";
  EXPECT_EQ(std::filesystem::status(token).permissions(), std::filesystem::perms(0600));
  const auto done = admin("whoami --json");
  ASSERT_EQ(done.status, 0) << done.output;
  const auto who = nlohmann::json::parse(done.output);
  EXPECT_EQ(who["user"], "admin");
  EXPECT_EQ(who["role"], "administrator");
  EXPECT_EQ(who["credential"], "local");
  expect_denied(as("stranger", "machine list"), "does not accept the token");
}

TEST_F(Identity, AnOperatorRunsWhatIsInHerGroupAndNothingElse) {
  system.start_gateway();
  system.wait_connected();
  system.push("O1", "G00 X1.\nM30\n");
  expect_good(admin("group add lathes lathe-1"));
  expect_good(admin("user add anna --role operator --group lathes --password", "correct horse"));
  expect_denied(as("anna", "login anna", "wrong horse"), "do not belong together");
  expect_good(as("anna", "login anna", "correct horse"));
  const auto logins = system.folder() / "anna" / ".config" / "dripline" / "logins.json";
  EXPECT_EQ(std::filesystem::status(logins).permissions(), std::filesystem::perms(0600));
  EXPECT_EQ(whoami("anna")["groups"], nlohmann::json({"lathes"}));

  const auto started = as("anna", "run start lathe-1 O1 --json");
  ASSERT_EQ(started.status, 0) << started.output;
  EXPECT_EQ(nlohmann::json::parse(started.output)["author"], "anna");
  system.wait_ended(nlohmann::json::parse(started.output)["id"]);
  expect_denied(as("anna", "run start mill-1 O1"), "machine mill-1");
  expect_denied(as("anna", "program remove O1"), "needs programmer");
  expect_denied(as("anna", "user list"), "needs administrator");

  expect_good(admin("group remove-machine lathes lathe-1"));
  expect_denied(as("anna", "run start lathe-1 O1"), "machine lathe-1");
  expect_good(as("anna", "logout"));
  expect_denied(as("anna", "whoami"), "does not accept the token");

  const auto trail = system.rest().get("/api/v1/audit?limit=1000").json()["entries"];
  bool has_start = false, has_refusal = false, has_sign_in = false;
  for (const auto& entry : trail) {
    if (entry["who"] != "anna") continue;
    EXPECT_EQ(entry["address"], "127.0.0.1") << entry;
    has_start |= entry["action"] == "run.start";
    has_refusal |= entry["action"] == "access.refused";
    has_sign_in |= entry["action"] == "sign-in";
  }
  EXPECT_TRUE(has_start && has_refusal && has_sign_in) << trail;
}

TEST_F(Identity, ATokenServesAProgramUntilItIsRevoked) {
  expect_good(admin("user add mes --role programmer --group all"));
  const auto made = admin("token add dashboard --user mes --role viewer 2>/dev/null");
  ASSERT_EQ(made.status, 0) << made.output;
  std::ofstream(system.folder() / "t") << made.output;
  restart_server();  // which ends no token
  const std::string with = "--token-file " + (system.folder() / "t").string() + " ";
  expect_good(as("mes", with + "program list"));
  expect_denied(as("mes", with + "program remove O1"), "needs programmer");
  const auto list = admin("token list --user mes --json");
  EXPECT_EQ(nlohmann::json::parse(list.output)["tokens"][0]["name"], "dashboard");
  expect_good(admin("user lock mes"));
  expect_denied(as("mes", with + "program list"), "does not accept");
  expect_good(admin("user unlock mes"));
  expect_good(as("mes", with + "program list"));
  expect_good(admin("token revoke dashboard --user mes"));
  expect_denied(as("mes", with + "program list"), "does not accept");
  EXPECT_EQ(admin("token revoke dashboard --user mes").status, 1);
}

TEST_F(Identity, AnotherTokenFileTakesThePlaceOfALostOne) {
  const auto before = system.folder() / "before";
  std::filesystem::rename(system.server_state() / "token", before);
  restart_server();
  expect_denied(as("admin", "--token-file " + before.string() + " whoami"), "does not accept");
  EXPECT_EQ(system.rest().get("/api/v1/server").status, 200);
}

TEST_F(Identity, ARemovedAdminComesBackOnlyByTheOwnerOfTheFolder) {
  expect_good(admin("user add chief --role administrator --password", "correct horse"));
  expect_good(as("chief", "login chief", "correct horse"));
  expect_good(as("chief", "user remove admin"));
  EXPECT_EQ(system.rest().get("/api/v1/server").status, 401);
  system.add_server_argument("--recover-admin");
  restart_server();
  EXPECT_EQ(system.rest().get("/api/v1/server").status, 200);
}

TEST_F(Identity, APersonChangesHerPassword) {
  expect_good(admin("user add anna --role viewer --password", "correct horse"));
  expect_good(as("anna", "login anna", "correct horse"));
  EXPECT_EQ(as("anna", "user password", "correct horse\nshort").status, 1);
  expect_good(as("anna", "user password", "correct horse\nanother horse"));
  expect_denied(as("other", "login anna", "correct horse"), "do not belong together");
  expect_good(as("other", "login anna", "another horse"));
}

}  // namespace
}  // namespace dripline::integration
