// The TLS side of the HTTP server against clients that are hostile or only slow.
#include <cstdlib>
#include <filesystem>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/server/api/http_attack.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

/// A certificate for localhost, in a folder of its own.
class HttpTlsAttack : public HttpAttack {
 protected:
  HttpTlsAttack() {
    options_.tls = api::TlsFiles{.certificate = folder_.path() / "cert.pem",
                                 .key = folder_.path() / "key.pem"};
    const std::string make = fmt::format(
        "openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 "
        "-subj /CN=localhost -out {} -keyout {} 2>/dev/null",
        options_.tls->certificate, options_.tls->key);
    EXPECT_EQ(std::system(make.c_str()), 0);
  }
  int s_client(const std::string& with) {
    return std::system(fmt::format("openssl s_client -connect 127.0.0.1:{} {} </dev/null "
                                   ">/dev/null 2>&1",
                                   server_->port(), with)
                           .c_str());
  }
  test_support::TemporaryFolder folder_;
};

TEST_F(HttpTlsAttack, IdleConnectionsDoNotKeepOutAHandshake) {
  start();
  const auto silent = idle(300);
  const std::string ask = fmt::format(
      "curl -sf --max-time 30 --cacert {} --connect-to localhost:443:127.0.0.1:{} "
      "https://localhost/health | grep -q fine",
      options_.tls->certificate, server_->port());
  EXPECT_EQ(std::system(ask.c_str()), 0);
}

TEST_F(HttpTlsAttack, AHandshakeMustComeInTime) {
  options_.limits.handshake = 200ms;
  start();
  RawPeer silent = peer();
  EXPECT_TRUE(silent.wait_for_end());
}

TEST_F(HttpTlsAttack, OnlyCiphersWithForwardSecrecy) {
  start();
  EXPECT_EQ(s_client("-tls1_3"), 0);
  EXPECT_EQ(s_client("-tls1_2"), 0);
  EXPECT_NE(s_client("-tls1_2 -cipher AES128-SHA:AES128-GCM-SHA256"), 0);
  EXPECT_NE(s_client("-tls1_1 -cipher ALL:@SECLEVEL=0"), 0);
}

TEST_F(HttpTlsAttack, AKeyThatOthersCanReadIsRefused) {
  std::filesystem::permissions(options_.tls->key, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  options_.address = api::parse_http_address("127.0.0.1:0").value();
  const auto server =
      api::HttpServer::start(options_, {.handle = [](const auto&) { return api::no_content(); }});
  ASSERT_FALSE(server);
  EXPECT_EQ(server.error().code, Errc::Denied);
  EXPECT_NE(server.error().what.find(options_.tls->key), std::string::npos);
}

}  // namespace
}  // namespace dripline::server_test
