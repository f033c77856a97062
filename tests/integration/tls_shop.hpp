#pragma once

#include <gtest/gtest.h>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tests/integration/system.hpp"

namespace dripline::integration {

/// Files for a server with TLS and an authority for people's certificates, made by openssl.
class TlsFiles {
 public:
  explicit TlsFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
    self_signed("server", "/CN=localhost", "subjectAltName=DNS:localhost,IP:127.0.0.1");
    for (const std::string authority : {"people", "strangers"})
      self_signed(authority, "/CN=" + authority, "basicConstraints=critical,CA:TRUE");
    std::ofstream(file("revoked")) << "# no one yet\n";
  }
  std::string file(const std::string& name) const { return folder_ / name; }
  std::vector<std::string> server_arguments() const {
    return {"--tls-certificate=" + file("server.pem"), "--tls-key=" + file("server.key"),
            "--tls-client-ca=" + file("people.pem"), "--tls-client-revoked=" + file("revoked")};
  }
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
  /// `dnc` at one of the servers, which people and scripts name with commas. `access`: see below.
  test_support::Finished dnc(const std::string& servers, const std::string& access,
                             const std::string& arguments) const {
    const std::string command = "env -u DRIPLINE_TOKEN -u XDG_CONFIG_HOME HOME=" + file("home") +
                                " " + program_path("dnc") + " --server " + servers + " --ca " +
                                file("server.pem") + " " + access + " " + arguments;
    return test_support::run_to_end({"/bin/sh", "-c", command}, folder_ / "dnc.out");
  }
  /// By the user's certificate, or as the owner of a state folder.
  std::string as_user(const std::string& user) const {
    return "--cert " + file(user + ".pem") + " --key " + file(user + ".key");
  }
  static std::string as_owner(const std::filesystem::path& state) {
    return "--token-file " + (state / "token").string();
  }

 private:
  void openssl(const std::string& arguments) const {
    const std::string command =
        "cd " + folder_.string() + " && openssl " + arguments + " >openssl.out 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
  void self_signed(const std::string& name, const std::string& subject,
                   const std::string& extension) const {
    openssl("req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj " +
            subject + " -addext " + extension + " -keyout " + name + ".key -out " + name + ".pem");
  }

  const std::filesystem::path folder_;
  std::map<std::string, std::string> serials_;
};

/// A server with TLS and client certificates. `dnc` is what its users type.
class TlsShop {
 public:
  TlsShop() : files(system.folder()) {
    for (const auto& argument : files.server_arguments()) system.add_server_argument(argument);
  }

  void start() {
    system.launch_server();
    ASSERT_TRUE(test_support::eventually([&] {
      return std::filesystem::exists(system.server_state() / "dncd.json") &&
             dnc("server status", "token").status == 0;
    })) << system.server().output()
        << dnc("server status", "token").output;
  }
  std::string file(const std::string& name) const { return files.file(name); }
  /// By the user's certificate; "token": as the owner of the state folder; "": as no one.
  test_support::Finished dnc(const std::string& arguments, const std::string& user) const {
    std::string access;
    if (user == "token") {
      access = TlsFiles::as_owner(system.server_state());
    } else if (!user.empty()) {
      access = files.as_user(user);
    }
    return files.dnc(system.url(), access, arguments);
  }

  System system;
  TlsFiles files;
};

}  // namespace dripline::integration
