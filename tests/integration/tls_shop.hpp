#pragma once

#include <gtest/gtest.h>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>

#include "tests/integration/system.hpp"

namespace dripline::integration {

/// A server with TLS, with an authority for people's certificates, made by openssl. `dnc` is what
/// its users type.
class TlsShop {
 public:
  TlsShop() {
    self_signed("server", "/CN=localhost", "subjectAltName=DNS:localhost,IP:127.0.0.1");
    for (const std::string authority : {"people", "strangers"})
      self_signed(authority, "/CN=" + authority, "basicConstraints=critical,CA:TRUE");
    std::ofstream(file("revoked")) << "# no one yet\n";
    for (const auto& argument :
         {"--tls-certificate=" + file("server.pem"), "--tls-key=" + file("server.key"),
          "--tls-client-ca=" + file("people.pem"), "--tls-client-revoked=" + file("revoked")})
      system.add_server_argument(argument);
  }

  void start() {
    system.launch_server();
    ASSERT_TRUE(test_support::eventually([&] {
      return std::filesystem::exists(system.server_state() / "dncd.json") &&
             dnc("server status", "token").status == 0;
    })) << system.server().output()
        << dnc("server status", "token").output;
  }
  std::string file(const std::string& name) const { return system.folder() / name; }
  void issue(const std::string& user, const std::string& authority = "people") {
    serials_[user] = "0A" + std::to_string(10 + serials_.size());
    openssl("req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj /CN=" + user +
            " -keyout " + user + ".key -out " + user + ".csr");
    openssl("x509 -req -days 2 -in " + user + ".csr -CA " + authority + ".pem -CAkey " + authority +
            ".key -set_serial 0x" + serials_[user] + " -out " + user + ".pem");
  }
  std::string serial(const std::string& user) const { return serials_.at(user); }
  void revoke(const std::string& user) {
    std::ofstream(file("revoked"), std::ios::app) << serial(user) << "  # " << user << '\n';
  }
  /// By the user's certificate; "token": as the owner of the state folder; "": as no one.
  test_support::Finished dnc(const std::string& arguments, const std::string& user) const {
    std::string access;
    if (user == "token") {
      access = " --token-file " + (system.server_state() / "token").string();
    } else if (!user.empty()) {
      access = " --cert " + file(user + ".pem") + " --key " + file(user + ".key");
    }
    const std::string command = "env -u DRIPLINE_TOKEN -u XDG_CONFIG_HOME HOME=" + file("home") +
                                " " + program_path("dnc") + " --server " + system.url() + " --ca " +
                                file("server.pem") + access + " " + arguments;
    return test_support::run_to_end({"/bin/sh", "-c", command}, system.folder() / "dnc.out");
  }

  System system;

 private:
  void openssl(const std::string& arguments) const {
    const std::string command =
        "cd " + system.folder().string() + " && openssl " + arguments + " >openssl.out 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  void self_signed(const std::string& name, const std::string& subject,
                   const std::string& extension) const {
    openssl("req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj " +
            subject + " -addext " + extension + " -keyout " + name + ".key -out " + name + ".pem");
  }

  std::map<std::string, std::string> serials_;
};

}  // namespace dripline::integration
