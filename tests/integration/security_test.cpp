// Server and gateways with DDS Security: the folders are made with `dnc pki`, as a shop does it.
#include <gtest/gtest.h>
#include <csignal>
#include <fstream>

#include "clients/tools/authority/access_documents.hpp"
#include "clients/tools/authority/disk.hpp"
#include "clients/tools/authority/signing.hpp"
#include "protocol/pki/certificate.hpp"
#include "protocol/pki/identity_files.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

namespace fs = std::filesystem;
using test_support::eventually;
using test_support::Finished;

std::string report_program(std::uint64_t lines, std::uint64_t moves_per_line) {
  std::string text;
  test_support::write_report_program(lines, moves_per_line,
                                     [&](std::string_view piece) { text += piece; });
  return text;
}

std::string text_of(const fs::path& file) {
  return pki::read_file(file.string()).value_or(std::string());
}

class SecuritySystem : public testing::Test {
 protected:
  SecuritySystem() {
    pki("init");
    pki("server");
    pki("gateway lathe-1");
    system.add_server_argument("--dds-security");
    system.add_server_argument(server_folder().string());
    use(gateway_folder("lathe-1"));
  }
  Finished try_pki(const std::string& arguments) const {
    return test_support::run_to_end(
        {"/bin/sh", "-c",
         program_path("dnc") + " pki " + arguments + " --folder " + shop().string()},
        folder.path() / "dnc.out");
  }
  void pki(const std::string& arguments) const {
    const auto done = try_pki(arguments);
    EXPECT_EQ(done.status, 0) << done.output;
  }
  fs::path shop() const { return folder.path() / "shop"; }
  fs::path server_folder() const { return shop() / "server"; }
  fs::path gateway_folder(const std::string& machine) const {
    return shop() / "gateways" / machine;
  }
  /// The next gateway's folder.
  void use(const fs::path& security) {
    system.use_gateway_arguments({"--dds-security", security.string()});
  }
  void start() {
    system.start_server();
    system.start_gateway();
    system.wait_connected();
  }
  void stop_server() {
    system.server().signal(SIGTERM);
    EXPECT_EQ(system.server().wait(), 0);
  }
  void expect_run_completes() {
    const auto run = system.wait_ended(system.start_run("O0300"));
    EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  }
  bool is_connected(const std::string& machine = "lathe-1") const {
    const auto view = system.rest().get("/api/v1/machines/" + machine).json();
    return view.is_object() && view.value("connected", false);
  }
  /// Replaces certificate and permissions by some that are over soon.
  void shorten(const fs::path& place, const authority::Holder& holder,
               std::chrono::seconds left) const {
    const UtcTime now = SystemClock().now();
    const authority::Validity validity{now - std::chrono::hours(1),
                                       std::chrono::floor<std::chrono::seconds>(now + left)};
    const authority::Signer identities{text_of(shop() / "authority/identity_ca.pem"),
                                       text_of(shop() / "authority/identity_ca.key")};
    const authority::Signer permissions{text_of(shop() / "authority/permissions_ca.pem"),
                                        text_of(shop() / "authority/permissions_ca.key")};
    const auto certificate =
        authority::make_certificate({.purpose = authority::Purpose::Identity,
                                     .shop = "dripline",
                                     .unit = std::string(authority::to_string(holder.role)),
                                     .name = holder.name,
                                     .serial = authority::new_serial(),
                                     .validity = validity},
                                    text_of(place / pki::kKeyFile), identities)
            .value();
    const auto subject = pki::parse_certificate(certificate).value().subject;
    const auto document =
        authority::sign_document(authority::permissions_document(holder, subject, validity),
                                 permissions)
            .value();
    ASSERT_TRUE(authority::replace_file(place / pki::kCertificateFile, {certificate}));
    ASSERT_TRUE(authority::replace_file(place / pki::kPermissionsFile, {document}));
  }

  test_support::TemporaryFolder folder;
  System system{{.speed = "1x",
                 .server_arguments = {},
                 .gateway_arguments = {},
                 .control = "centurion",
                 .gateway_environment = {},
                 .lease_ms = "3000"}};
};

TEST_F(SecuritySystem, AProgramRunsEncryptedAcrossARestartOfTheServer) {
  start();
  system.push("O0300", report_program(60, 9));
  const std::string id = system.start_run("O0300");
  ASSERT_TRUE(eventually([&] { return system.run(id).value("executed", 0u) > 3; }));
  stop_server();
  system.start_server();
  system.wait_connected();
  const auto run = system.wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(run.value("content_verified", false));
  EXPECT_EQ(system.report_lines(id).size(), 60U);
}

TEST_F(SecuritySystem, ARenewedCertificateIsTakenAtTheNextStart) {
  start();
  system.push("O0300", report_program(5, 2));
  expect_run_completes();
  pki("renew lathe-1");
  system.gateway().signal(SIGTERM);
  EXPECT_EQ(system.gateway().wait(), 0);
  system.start_gateway();
  ASSERT_TRUE(eventually([&] { return is_connected(); }));
  expect_run_completes();
  pki("renew --server");
  stop_server();
  system.start_server();
  system.wait_connected();
  expect_run_completes();
}

TEST_F(SecuritySystem, ARevokedGatewayStaysOut) {
  pki("gateway lathe-2");
  const auto stolen = folder.path() / "stolen";
  fs::copy(gateway_folder("lathe-1"), stolen);
  pki("revoke lathe-1");
  use(stolen);
  system.start_server();
  system.start_gateway("lathe-1");
  auto thief = std::move(system.gateway());
  use(gateway_folder("lathe-2"));
  system.start_gateway("lathe-2");
  system.wait_connected("lathe-2");
  EXPECT_FALSE(is_connected("lathe-1"));
  EXPECT_TRUE(thief.is_running());
  // The machine's next computer.
  pki("gateway lathe-1");
  use(gateway_folder("lathe-1"));
  thief.kill();
  fs::remove_all(system.folder() / "gateway");
  system.start_gateway("lathe-1");
  system.wait_connected("lathe-1");
}

TEST_F(SecuritySystem, StrangersStayOut) {
  system.start_server();
  const auto foreign = folder.path() / "foreign";
  for (const std::string arguments : {"init", "gateway lathe-1"}) {
    const auto made = test_support::run_to_end(
        {"/bin/sh", "-c",
         program_path("dnc") + " pki " + arguments + " --folder " + foreign.string()},
        folder.path() / "dnc.out");
    ASSERT_EQ(made.status, 0) << made.output;
  }
  use(foreign / "gateways/lathe-1");
  auto of_another_shop = system.second_gateway("lathe-1");
  system.use_gateway_arguments({});
  system.start_gateway("lathe-1");
  auto without = std::move(system.gateway());
  pki("gateway mill-2");
  use(gateway_folder("mill-2"));
  system.start_gateway("mill-2");
  system.wait_connected("mill-2");
  EXPECT_EQ(system.rest().get("/api/v1/machines").json()["machines"].size(), 1U);
  EXPECT_TRUE(without.is_running());
  EXPECT_TRUE(of_another_shop.is_running());
}

TEST_F(SecuritySystem, AFolderThatDoesNotFitIsRefusedWithItsReason) {
  const auto refused = [&](std::vector<std::string> command, const std::string& part) {
    command.insert(command.end(), {"--state", (folder.path() / "state").string()});
    const auto done = test_support::run_to_end(command, folder.path() / "out");
    EXPECT_EQ(done.status, 2) << done.output;
    EXPECT_NE(done.output.find(part), std::string::npos) << done.output;
  };
  const auto lathe = gateway_folder("lathe-1").string();
  refused({program_path("dncgw"), "--machine", "lathe-2", "--control", "centurion",
           "--dds-security", lathe},
          "'lathe-1', not of machine 'lathe-2'");
  refused({program_path("dncd"), "--http", "127.0.0.1:0", "--dds-security", lathe}, "of a gateway");
  refused({program_path("dncgw"), "--machine", "lathe-1", "--control", "centurion",
           "--dds-security", server_folder().string()},
          "of a server");
  shorten(gateway_folder("lathe-1"), {authority::Role::Gateway, "lathe-1"},
          std::chrono::seconds(-5));
  refused({program_path("dncgw"), "--machine", "lathe-1", "--control", "centurion",
           "--dds-security", lathe},
          "has expired");
}

TEST_F(SecuritySystem, TheServerWarnsOfCertificatesThatEndSoon) {
  pki("renew lathe-1 --days 20");
  pki("renew --server --days 200");
  start();
  const bool warned = eventually(
      [&] { return system.rest().get("/api/v1/health").json().value("status", "") == "degraded"; });
  EXPECT_TRUE(warned);
  const auto health = system.rest().get("/api/v1/health").body;
  EXPECT_NE(health.find("the DDS certificate of a gateway expires in 19 days"), std::string::npos)
      << health;
  const auto metrics = system.rest().get("/api/v1/metrics").body;
  EXPECT_NE(metrics.find("dripline_certificate_expiry_timestamp_seconds{use=\"dds\"} "),
            std::string::npos);
  EXPECT_NE(metrics.find("{use=\"gateway\",machine=\"lathe-1\"} "), std::string::npos) << metrics;
  const auto log = text_of(system.folder() / "dncd.log");
  EXPECT_NE(log.find("the DDS certificate of a gateway expires in 19 days: machine=lathe-1"),
            std::string::npos)
      << log;
}

/// Whoever overlooks the warnings: the connection ends, both programs live, and a renewed
/// certificate brings the machine back.
TEST_F(SecuritySystem, AMachineWhoseCertificateEndsIsLostUntilItIsRenewed) {
  shorten(gateway_folder("lathe-1"), {authority::Role::Gateway, "lathe-1"},
          std::chrono::seconds(15));
  start();
  ASSERT_TRUE(eventually([&] { return !is_connected(); }, std::chrono::seconds(60)));
  EXPECT_TRUE(system.server().is_running());
  EXPECT_TRUE(system.gateway().is_running()) << system.gateway().output();
  EXPECT_TRUE(eventually([&] {
    return text_of(system.folder() / "gateway.log").find("the DDS certificate has expired") !=
           std::string::npos;
  }));
  system.gateway().signal(SIGTERM);
  EXPECT_TRUE(system.gateway().wait());
  pki("renew lathe-1");
  system.start_gateway();
  ASSERT_TRUE(eventually([&] { return is_connected(); }));
}

TEST_F(SecuritySystem, AServerWhoseCertificateEndsLivesAndIsRenewed) {
  shorten(server_folder(), authority::the_server(), std::chrono::seconds(15));
  start();
  ASSERT_TRUE(eventually([&] { return !is_connected(); }, std::chrono::seconds(60)));
  EXPECT_TRUE(system.server().is_running()) << system.server().output();
  EXPECT_TRUE(system.gateway().is_running()) << system.gateway().output();
  EXPECT_EQ(system.rest().get("/api/v1/health").json().value("status", ""), "degraded");
  pki("renew --server");
  system.server().signal(SIGTERM);
  EXPECT_EQ(system.server().wait(), 0);
  system.start_server();
  system.wait_connected();
}

}  // namespace
}  // namespace dripline::integration
