// DDS Security with certificates made here, in a temporary folder.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "network.hpp"

namespace dripline::dds::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGovernance = R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
<domains><id_range><min>0</min><max>230</max></id_range></domains>
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>NONE</liveliness_protection_kind>
<rtps_protection_kind>NONE</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>false</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>NONE</metadata_protection_kind>
<data_protection_kind>ENCRYPT</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
)";

std::string permissions(const std::string& name, const std::string& partition) {
  const std::string rule = "<topics><topic>dripline_*</topic></topics><partitions><partition>" +
                           partition + "</partition></partitions>";
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name=")" +
         name + R"("><subject_name>CN=)" + name + R"(,O=dripline</subject_name>
<validity><not_before>2020-01-01T00:00:00</not_before><not_after>2099-01-01T00:00:00</not_after></validity>
<allow_rule><domains><id_range><min>0</min><max>230</max></id_range></domains>
<publish>)" +
         rule + "</publish><subscribe>" + rule + R"(</subscribe></allow_rule>
<default>DENY</default></grant></permissions></dds>
)";
}

/// A certificate authority of identities and permissions in its own folder.
class Authority {
 public:
  explicit Authority(fs::path folder) : folder_(std::move(folder)) {
    fs::create_directories(folder_);
    make_key("ca");
    openssl("req -x509 -new -key ca.key -sha256 -days 3650 -subj /O=dripline/CN=ca -out ca.pem");
    sign("governance", kGovernance);
  }
  SecurityFiles certify(const std::string& name, const std::string& partition) {
    make_key(name);
    openssl("req -new -key " + name + ".key -subj /O=dripline/CN=" + name + " -out " + name +
            ".csr");
    openssl("x509 -req -in " + name + ".csr -CA ca.pem -CAkey ca.key -CAcreateserial -sha256 " +
            "-days 3650 -out " + name + ".pem");
    sign(name, permissions(name, partition));
    return {.identity_ca = path("ca.pem"),
            .certificate = path(name + ".pem"),
            .private_key = path(name + ".key"),
            .permissions_ca = path("ca.pem"),
            .governance = path("governance.p7s"),
            .permissions = path(name + ".p7s"),
            .revocation_list = std::nullopt};
  }

 private:
  std::string path(const std::string& file) const { return (folder_ / file).string(); }
  void openssl(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.string() + "' && openssl " + arguments + " >>openssl.log 2>&1";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  }
  void make_key(const std::string& name) const {
    openssl("ecparam -name prime256v1 -genkey -noout -out " + name + ".key");
  }
  void sign(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / (name + ".xml")) << text;
    openssl("smime -sign -text -in " + name + ".xml -out " + name +
            ".p7s -signer ca.pem -inkey ca.key");
  }

  fs::path folder_;
};

class Security : public Network {
 protected:
  Security() {
    std::string pattern = (fs::temp_directory_path() / "dripline-security-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    authority_ = std::make_unique<Authority>(folder_ / "ours");
    options_.lease_ms = 5000;
  }
  ~Security() override {
    std::error_code ec;
    fs::remove_all(folder_, ec);
  }
  std::unique_ptr<TestServer> open_secure_server() {
    options_.security = authority_->certify("server", "*");
    return open_server();
  }
  std::unique_ptr<TestGateway> open_as(const std::string& machine,
                                       std::optional<SecurityFiles> files) {
    options_.security = std::move(files);
    return open_gateway(machine);
  }
  /// A certified gateway that came later has been announced, the stranger has not.
  void expect_shut_out(TestServer& server, TestGateway& stranger) {
    auto friendly = open_as("lathe-2", authority_->certify("gw2", "machine.lathe-2"));
    const auto announced = server.announces.take(30s);
    ASSERT_TRUE(announced);
    EXPECT_EQ(announced->machine, "lathe-2");
    EXPECT_FALSE(stranger.endpoint->is_connected());
    EXPECT_EQ(server.announces.size(), 0U);
  }

  fs::path folder_;
  std::unique_ptr<Authority> authority_;
};

TEST_F(Security, CertifiedEndsTalk) {
  auto server = open_secure_server();
  auto gateway = open_as("lathe-1", authority_->certify("gw1", "machine.lathe-1"));
  ASSERT_EQ(server->announces.take(30s), announce("lathe-1"));
  ASSERT_TRUE(server->endpoint->write(block_data("lathe-1", 0, 1000)));
  EXPECT_EQ(gateway->blocks.take(), block_data("lathe-1", 0, 1000));
  ASSERT_EQ(gateway->server.take(), true);
  ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 1)));
  EXPECT_EQ(server->records.take(), record("lathe-1", 1));
}

TEST_F(Security, AGatewayWithoutACertificateIsShutOut) {
  auto server = open_secure_server();
  auto stranger = open_as("lathe-1", std::nullopt);
  expect_shut_out(*server, *stranger);
}

TEST_F(Security, AGatewayOfAForeignAuthorityIsShutOut) {
  auto server = open_secure_server();
  Authority foreign(folder_ / "foreign");
  auto stranger = open_as("lathe-1", foreign.certify("gw1", "machine.lathe-1"));
  expect_shut_out(*server, *stranger);
}

TEST_F(Security, ACertifiedGatewayCannotPlayAnotherMachine) {
  auto server = open_secure_server();
  options_.security = authority_->certify("gw1", "machine.lathe-1");
  EXPECT_FALSE(GatewayEndpoint::open(options_, "lathe-3", {}));
}

TEST_F(Security, AMissingFileIsNamed) {
  options_.security = authority_->certify("gw1", "machine.lathe-1");
  options_.security->governance = "/nowhere/governance.p7s";
  const auto opened = GatewayEndpoint::open(options_, "lathe-1", {});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::NotFound);
  EXPECT_NE(opened.error().what.find("/nowhere/governance.p7s"), std::string::npos);
}

}  // namespace
}  // namespace dripline::dds::test
