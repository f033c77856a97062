// People and scripts with certificates, sessions and tokens, when another server has the library.
#include "tests/integration/standby/standby_fixture.hpp"
#include "tests/integration/tls_shop.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;

class TakenSessions : public TwoServersTest {
 protected:
  std::string both() const { return shop_->rest(1).url() + "," + shop_->rest(0).url(); }
  int list_by(const std::string& access) const {
    return files_.dnc(both(), access, "program list").status;
  }
  /// Of a new session or token.
  std::string secret_of(const std::string& path, const json& body) const {
    const auto issued = shop_->rest(0).post(path, body);
    EXPECT_EQ(issued.status, 201) << issued.body;
    return issued.json().value("secret", issued.json().value("token", ""));
  }
  int status_by(int server, const std::string& secret) const {
    return test_support::RestClient(shop_->rest(server).url(), secret)
        .get("/api/v1/programs")
        .status;
  }

  const test_support::TemporaryFolder folder_;
  TlsFiles files_{folder_.path()};
};

TEST_F(TakenSessions, AreWorthTheSameAtTheOtherServer) {
  begin(files_.server_arguments());
  for (const std::string user : {"anna", "bert"}) {
    files_.issue(user);
    const auto added = shop_->rest(0).post(
        "/api/v1/users", {{"name", user}, {"role", "viewer"}, {"password", "correct horse"}});
    ASSERT_EQ(added.status, 201) << added.body;
  }
  files_.issue("admin", "strangers");
  EXPECT_EQ(list_by(files_.as_user("anna")), 0) << "the active one of both is found";
  EXPECT_EQ(list_by(files_.as_user("admin")), 3) << "ends in the handshake of both";
  const auto waiting = files_.dnc(shop_->rest(1).url(), files_.as_user("anna"), "program list");
  EXPECT_NE(waiting.status, 0) << waiting.output;
  EXPECT_NE(waiting.output.find("has the library. Ask that one"), std::string::npos)
      << waiting.output;
  const json sign_in{{"user", "bert"}, {"password", "correct horse"}, {"bearer", true}};
  const std::string session = secret_of("/api/v1/session", sign_in);
  const std::string token = secret_of("/api/v1/users/bert/tokens", {{"name", "robot"}});
  const std::string ended = secret_of("/api/v1/session", sign_in);
  EXPECT_LT(test_support::RestClient(shop_->rest(0).url(), ended).remove("/api/v1/session").status,
            300);
  EXPECT_EQ(status_by(0, session), 200);
  EXPECT_EQ(status_by(0, ended), 401);
  files_.revoke("anna");  // the active one may not have read it yet
  shop_->server(0).kill();
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  EXPECT_EQ(list_by(files_.as_user("anna")), 4) << "revoked: read at the start of a server's turn";
  EXPECT_EQ(list_by(files_.as_user("bert")), 0);
  EXPECT_EQ(list_by(files_.as_user("admin")), 3);
  EXPECT_EQ(status_by(1, session), 200);
  EXPECT_EQ(status_by(1, token), 200);
  EXPECT_EQ(status_by(1, ended), 401) << "a session that was ended stays so";
}

/// At the moment of need it would be too late.
TEST_F(TakenSessions, AListOfRevokedCertificatesThatIsNotThereKeepsAServerFromWaiting) {
  begin(files_.server_arguments());
  shop_->server(1).signal(SIGTERM);
  ASSERT_EQ(shop_->server(1).wait(), 0);
  std::vector<std::string> command{program_path("dncd"),
                                   "--state",
                                   shop_->state(1),
                                   "--store",
                                   store('b'),
                                   "--standby",
                                   "yes",
                                   "--http",
                                   "127.0.0.1:0",
                                   "--dds-domain",
                                   std::to_string(shop_->domain()),
                                   "--dds-port",
                                   std::to_string(shop_->dds_port(1))};
  auto tls = files_.server_arguments();
  tls.back() += ".missing";
  command.insert(command.end(), tls.begin(), tls.end());
  const auto refused = test_support::run_to_end(command, shop_->folder() / "refused.out");
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.output.find("tls-client-revoked: "), std::string::npos) << refused.output;
}

}  // namespace
}  // namespace dripline::integration
