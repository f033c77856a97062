#include "server/mqtt/tls_client.hpp"

#include <gtest/gtest.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace dripline::mqtt {
namespace {

template <auto kFree>
struct Freed {
  template <class T>
  void operator()(T* thing) const {
    kFree(thing);
  }
};

/// A broker of OpenSSL that is given bytes, as the client is.
class TlsClientTest : public testing::Test {
 protected:
  TlsClientTest() {
    key_.reset(EVP_EC_gen("P-256"));
    certificate_.reset(X509_new());
    X509_set_version(certificate_.get(), X509_VERSION_3);
    X509_gmtime_adj(X509_getm_notBefore(certificate_.get()), -3600);
    X509_gmtime_adj(X509_getm_notAfter(certificate_.get()), 3600);
    X509_NAME* const name = X509_get_subject_name(certificate_.get());
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC,
                               reinterpret_cast<const unsigned char*>("broker.example"), -1, -1, 0);
    X509_set_issuer_name(certificate_.get(), name);
    X509_set_pubkey(certificate_.get(), key_.get());
    const std::unique_ptr<X509_EXTENSION, Freed<&X509_EXTENSION_free>> names(
        X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "DNS:broker.example"));
    X509_add_ext(certificate_.get(), names.get(), -1);
    X509_sign(certificate_.get(), key_.get(), EVP_sha256());
    const auto ca = folder_.path() / "ca.pem";
    const std::unique_ptr<FILE, Freed<&fclose>> file(fopen(ca.c_str(), "w"));
    PEM_write_X509(file.get(), certificate_.get());
    settings_.host = "broker.example";
    settings_.ca = ca;
  }
  /// With TLS 1.3, after its handshake.
  TlsClient connect() {
    context_.reset(SSL_CTX_new(TLS_server_method()));
    SSL_CTX_set_min_proto_version(context_.get(), TLS1_3_VERSION);
    SSL_CTX_use_certificate(context_.get(), certificate_.get());
    SSL_CTX_use_PrivateKey(context_.get(), key_.get());
    broker_.reset(SSL_new(context_.get()));
    SSL_set_bio(broker_.get(), BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
    SSL_set_accept_state(broker_.get());
    auto client = TlsClient::make(settings_);
    EXPECT_TRUE(client) << client.error().what;
    for (int i = 0; i < 10; ++i) {
      const std::string sent = client->take_output();
      BIO_write(SSL_get_rbio(broker_.get()), sent.data(), static_cast<int>(sent.size()));
      SSL_do_handshake(broker_.get());
      EXPECT_TRUE(take(*client));
    }
    EXPECT_TRUE(client->is_open());
    return *std::move(client);
  }
  /// What the broker sends.
  Result<void> take(TlsClient& client) {
    std::string bytes(BIO_ctrl_pending(SSL_get_wbio(broker_.get())), '\0'), plain;
    if (bytes.empty()) return {};
    BIO_read(SSL_get_wbio(broker_.get()), bytes.data(), static_cast<int>(bytes.size()));
    return client.receive(bytes, plain);
  }
  /// For other keys.
  Result<void> wish(TlsClient& client) {
    SSL_key_update(broker_.get(), SSL_KEY_UPDATE_REQUESTED);
    SSL_do_handshake(broker_.get());
    return take(client);
  }

  test_support::TemporaryFolder folder_;
  std::unique_ptr<EVP_PKEY, Freed<&EVP_PKEY_free>> key_;
  std::unique_ptr<X509, Freed<&X509_free>> certificate_;
  std::unique_ptr<SSL_CTX, Freed<&SSL_CTX_free>> context_;
  std::unique_ptr<SSL, Freed<&SSL_free>> broker_;
  MqttSettings settings_;
};

/// Each of its wishes for other keys is answered.
TEST_F(TlsClientTest, EndsWithABrokerThatTakesNoAnswers) {
  TlsClient client = connect();
  Result<void> taken;
  for (int i = 0; i < 20'000 && taken; ++i) taken = wish(client);
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, Errc::LimitExceeded) << taken.error().what;
}

TEST_F(TlsClientTest, AnswersABrokerThatTakesIt) {
  TlsClient client = connect();
  std::size_t answered = 0;
  for (int i = 0; i < 20'000; ++i) {
    ASSERT_TRUE(wish(client));
    answered += client.take_output().size();
  }
  EXPECT_GT(answered, TlsClient::kMaxOutput);
}

}  // namespace
}  // namespace dripline::mqtt
