// DDS Security with the folders that `dnc pki` makes, and what strangers and thieves try.
#include <dds/dds.h>

#include <filesystem>

#include "clients/tools/authority/access_documents.hpp"
#include "network.hpp"
#include "protocol/dds/configuration.hpp"
#include "protocol/dds/impl/encode.hpp"
#include "protocol/dds/impl/topic.hpp"
#include "protocol/dds/qos.hpp"
#include "shop_authority.hpp"

namespace dripline::dds::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::days;

/// A participant made by hand: nothing of ours limits what it tries. `is_permissive` switches off
/// the checks of its own process too, as changed software would.
class Attacker {
 public:
  Attacker(NetworkOptions options, const SecurityFiles& files, const std::string& target,
           bool is_permissive) {
    const auto configuration =
        domain_configuration(options, Role::Gateway, cell_of(target)).value();
    static dds_domainid_t next = 150;
    domain_ = dds_create_domain(next, configuration.c_str());
    Qos qos(dds_create_qos());
    const auto set = [&](const std::string& name, const std::string& value) {
      dds_qset_prop(qos.get(), ("dds.sec." + name).c_str(), value.c_str());
    };
    const auto plugin = [&](const std::string& service, const std::string& library,
                            const std::string& function) {
      set(service + ".library.path", library);
      set(service + ".library.init", "init_" + function);
      set(service + ".library.finalize", "finalize_" + function);
    };
    plugin("auth", "dds_security_auth", "authentication");
    plugin("crypto", "dds_security_crypto", "crypto");
    if (is_permissive) {
      plugin("access", PERMISSIVE_ACCESS_CONTROL, "permissive");
    } else {
      plugin("access", "dds_security_ac", "access_control");
    }
    set("auth.identity_ca", "file:" + files.identity_ca);
    set("auth.identity_certificate", "file:" + files.certificate);
    set("auth.private_key", "file:" + files.private_key);
    set("access.permissions_ca", "file:" + files.permissions_ca);
    set("access.governance", "file:" + files.governance);
    set("access.permissions", "file:" + files.permissions);
    participant_ = dds_create_participant(next++, qos.get(), nullptr);
  }
  ~Attacker() {
    if (domain_ > 0) dds_delete(domain_);
  }
  Attacker(const Attacker&) = delete;
  Attacker& operator=(const Attacker&) = delete;

  bool is_in() const { return participant_ > 0; }
  /// Below zero: its own process refused it.
  template <class Message>
  dds_entity_t writer(const std::string& partition) {
    const Qos where = partition_qos(partition);
    const auto publisher = dds_create_publisher(participant_, where.get(), nullptr);
    const Qos qos = topic_qos<Message>();
    return dds_create_writer(publisher, topic<Message>(), qos.get(), nullptr);
  }
  template <class Message>
  dds_entity_t reader(const std::string& partition) {
    const Qos where = partition_qos(partition);
    const auto subscriber = dds_create_subscriber(participant_, where.get(), nullptr);
    const Qos qos = topic_qos<Message>();
    return dds_create_reader(subscriber, topic<Message>(), qos.get(), nullptr);
  }
  template <class Message>
  static void write(dds_entity_t writer, const Message& message) {
    auto sample = std::make_unique<SampleOf<Message>>();
    ASSERT_TRUE(encode(message, *sample));
    EXPECT_EQ(dds_write(writer, sample.get()), DDS_RETCODE_OK);
  }
  static std::size_t received(dds_entity_t reader) {
    constexpr std::size_t kMax = 8;
    void* samples[kMax] = {};
    dds_sample_info_t infos[kMax];
    const auto count = dds_take(reader, samples, infos, kMax, kMax);
    if (count > 0) dds_return_loan(reader, samples, count);
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  static bool is_matched(dds_entity_t writer) {
    dds_publication_matched_status_t status;
    return dds_get_publication_matched_status(writer, &status) == DDS_RETCODE_OK &&
           status.current_count > 0;
  }

 private:
  template <class Message>
  dds_entity_t topic() {
    return dds_create_topic(participant_, &Topic<Message>::descriptor(), Topic<Message>::kName,
                            nullptr, nullptr);
  }
  dds_entity_t domain_ = 0, participant_ = 0;
};

class Security : public Network {
 protected:
  Security() { options_.lease_ms = 5000; }
  std::unique_ptr<TestServer> open_secure_server() {
    options_.security = shop_.server();
    return open_server();
  }
  std::unique_ptr<TestGateway> open_as(const std::string& machine,
                                       std::optional<SecurityFiles> files) {
    options_.security = std::move(files);
    return open_gateway(machine);
  }
  Result<std::unique_ptr<GatewayEndpoint>> try_as(const std::string& machine,
                                                  const SecurityFiles& files) {
    options_.security = files;
    return GatewayEndpoint::open(options_, machine, {});
  }
  /// A certified gateway that came later has been announced, the stranger has not.
  void expect_shut_out(TestServer& server, TestGateway& stranger) {
    auto friendly = open_as("lathe-2", shop_.gateway_files("lathe-2"));
    const auto announced = server.announces.take(30s);
    ASSERT_TRUE(announced);
    EXPECT_EQ(announced->machine, "lathe-2");
    EXPECT_FALSE(stranger.endpoint->is_connected());
    EXPECT_EQ(server.announces.size(), 0U);
  }
  /// A copy of lathe-1's folder, to be changed.
  fs::path copy_of_lathe() {
    const auto copy = shop_.path() / "copy";
    fs::copy(shop_.folder(ShopAuthority::gateway("lathe-1")), copy);
    return copy;
  }
  authority::Validity around_now() const {
    return {shop_.clock().now() - days(2), shop_.clock().now() + days(2)};
  }

  ShopAuthority shop_;
};

TEST_F(Security, CertifiedEndsTalk) {
  auto server = open_secure_server();
  auto gateway = open_as("lathe-1", shop_.gateway_files("lathe-1"));
  ASSERT_EQ(server->announces.take(30s), announce("lathe-1"));
  ASSERT_TRUE(server->endpoint->write(block_data("lathe-1", 0, 1000)));
  EXPECT_EQ(gateway->blocks.take(), block_data("lathe-1", 0, 1000));
  ASSERT_EQ(gateway->server.take(), true);
  ASSERT_TRUE(gateway->endpoint->write(record("lathe-1", 1)));
  EXPECT_EQ(server->records.take(), record("lathe-1", 1));
}

TEST_F(Security, ARenewedGatewayTalksToAServerThatWasNotRestarted) {
  auto server = open_secure_server();
  auto gateway = open_as("lathe-1", shop_.gateway_files("lathe-1"));
  ASSERT_EQ(server->announces.take(30s), announce("lathe-1"));
  gateway.reset();
  ASSERT_TRUE(shop_->renew(ShopAuthority::gateway("lathe-1"), 20));
  gateway = open_as("lathe-1", shop_.gateway_files("lathe-1"));
  EXPECT_EQ(gateway->server.take(30s), true);
}

TEST_F(Security, AGatewayWithoutACertificateIsShutOut) {
  auto server = open_secure_server();
  auto stranger = open_as("lathe-1", std::nullopt);
  expect_shut_out(*server, *stranger);
}

TEST_F(Security, AGatewayOfAForeignAuthorityIsShutOut) {
  auto server = open_secure_server();
  ShopAuthority foreign;  // with the same names
  auto stranger = open_as("lathe-1", foreign.gateway_files("lathe-1"));
  expect_shut_out(*server, *stranger);
}

TEST_F(Security, ARevokedGatewayIsShutOut) {
  const auto stolen = copy_of_lathe();
  (void)shop_.server();
  ASSERT_TRUE(shop_->revoke(ShopAuthority::gateway("lathe-1")));
  auto server = open_secure_server();
  auto stranger = open_as("lathe-1", ShopAuthority::files(stolen));
  expect_shut_out(*server, *stranger);
}

TEST_F(Security, ACertifiedGatewayCannotPlayAnotherMachine) {
  auto server = open_secure_server();
  EXPECT_FALSE(try_as("lathe-3", shop_.gateway_files("lathe-1")));
}

TEST_F(Security, AnExpiredCertificateOpensNothing) {
  const auto copy = copy_of_lathe();
  const authority::Validity over{shop_.clock().now() - days(10), shop_.clock().now() - days(1)};
  const auto expired = authority::make_certificate({.purpose = authority::Purpose::Identity,
                                                    .shop = "shop",
                                                    .unit = "gateway",
                                                    .name = "lathe-1",
                                                    .serial = authority::new_serial(),
                                                    .validity = over},
                                                   text_of(copy / "key.pem"), shop_.identities());
  ASSERT_TRUE(expired);
  write_text(copy / "certificate.pem", *expired);
  EXPECT_FALSE(try_as("lathe-1", ShopAuthority::files(copy)));
}

TEST_F(Security, PermissionsThatWereChangedByOneLetterOpenNothing) {
  const auto copy = copy_of_lathe();
  auto text = text_of(copy / "permissions.p7s");
  const auto at = text.find("machine.lathe-1");
  ASSERT_NE(at, std::string::npos);
  text[at + std::string("machine.lathe-").size()] = '2';
  write_text(copy / "permissions.p7s", text);
  EXPECT_FALSE(try_as("lathe-2", ShopAuthority::files(copy)));
}

TEST_F(Security, AMissingFileIsNamed) {
  auto files = shop_.gateway_files("lathe-1");
  files.governance = "/nowhere/governance.p7s";
  const auto opened = try_as("lathe-1", files);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::NotFound);
  EXPECT_NE(opened.error().what.find("/nowhere/governance.p7s"), std::string::npos);
}

/// Lathe-1's own key and certificate, in other software: what its permissions do not name does not
/// get through, although its own process allows everything.
TEST_F(Security, AStolenGatewayReachesNothingButItsOwnMachine) {
  auto server = open_secure_server();
  auto victim = open_as("lathe-2", shop_.gateway_files("lathe-2"));
  ASSERT_EQ(server->announces.take(30s), announce("lathe-2"));
  ASSERT_EQ(victim->server.take(), true);

  // The cell of lathe-2 serves the attacker too when it asks there.
  Attacker thief(options_, shop_.gateway_files("lathe-1"), "lathe-2", true);
  ASSERT_TRUE(thief.is_in());
  const auto commands = thief.writer<Command>("machine.lathe-2");
  const auto acks = thief.writer<RecordAck>("machine.lathe-2");
  const auto announces = thief.writer<Announce>("machine.lathe-2");
  const auto records = thief.writer<Record>("machine.lathe-2");
  const auto everywhere = thief.writer<Announce>("machine.*");
  const auto blocks = thief.reader<BlockData>("machine.lathe-2");
  const auto all_blocks = thief.reader<BlockData>("machine.*");
  const auto everything = thief.reader<BlockData>("*");
  ASSERT_GT(commands, 0);
  ASSERT_GT(blocks, 0);
  // What it may do shows that it is in, and when its other attempts have been judged.
  const auto own = thief.writer<Announce>("machine.lathe-1");
  const auto end = std::chrono::steady_clock::now() + 30s;
  while (!Attacker::is_matched(own) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(10ms);
  ASSERT_TRUE(Attacker::is_matched(own));

  for (int i = 0; i < 3; ++i) {
    Command abort;
    abort.machine = "lathe-2";
    abort.id = fmt::format("forged-{}", i);
    abort.action = CommandAction::Abort;
    Attacker::write(commands, abort);
    Attacker::write(acks, RecordAck{.machine = "lathe-2", .epoch = 7, .number = 100});
    Attacker::write(announces, announce("lathe-2", 99));
    Attacker::write(everywhere, announce("lathe-2", 98));
    Attacker::write(records, record("lathe-2", 50));
    ASSERT_TRUE(server->endpoint->write(block_data("lathe-2", 0, 1000)));
    EXPECT_EQ(victim->blocks.take(), block_data("lathe-2", 0, 1000));
    ASSERT_TRUE(victim->endpoint->write(record("lathe-2", 1)));
    EXPECT_EQ(server->records.take(), record("lathe-2", 1));
  }
  EXPECT_EQ(victim->commands.size(), 0U);
  EXPECT_EQ(victim->acks.size(), 0U);
  EXPECT_EQ(server->announces.size(), 0U);
  EXPECT_EQ(server->rivals.size(), 0U);
  EXPECT_EQ(server->records.size(), 0U);
  EXPECT_EQ(Attacker::received(blocks), 0U);
  EXPECT_EQ(Attacker::received(all_blocks), 0U);
  EXPECT_EQ(Attacker::received(everything), 0U);
}

/// Cyclone DDS accepts documents of signers that the authority certified. A gateway's key is none.
TEST_F(Security, AGatewayCannotSignItselfMorePermissions) {
  auto server = open_secure_server();
  const auto copy = copy_of_lathe();
  const auto text = authority::permissions_document(authority::the_server(),
                                                    "CN=lathe-1,OU=gateway,O=shop", around_now());
  const authority::Signer own{text_of(copy / "certificate.pem"), text_of(copy / "key.pem")};
  write_text(copy / "permissions.p7s", authority::sign_document(text, own).value());
  EXPECT_FALSE(try_as("lathe-1", ShopAuthority::files(copy)));
  // With an authority of its own beside it, its own process believes it; the server does not.
  ShopAuthority foreign;
  write_text(copy / "permissions.p7s",
             authority::sign_document(text, foreign.permissions()).value());
  write_text(
      copy / "governance.p7s",
      authority::sign_document(authority::governance_document(), foreign.permissions()).value());
  write_text(copy / "permissions_ca.pem", foreign.permissions().certificate);
  options_.security = ShopAuthority::files(copy);
  Attacker thief(options_, *options_.security, "lathe-2", false);
  ASSERT_TRUE(thief.is_in());
  const auto commands = thief.writer<Command>("machine.lathe-2");
  ASSERT_GT(commands, 0);
  auto victim = open_as("lathe-2", shop_.gateway_files("lathe-2"));
  ASSERT_EQ(server->announces.take(30s), announce("lathe-2"));
  EXPECT_FALSE(Attacker::is_matched(commands));
  EXPECT_EQ(victim->commands.size(), 0U);
}

}  // namespace
}  // namespace dripline::dds::test
