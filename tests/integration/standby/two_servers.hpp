#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/rest_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::integration {

/// Two servers of one PostgreSQL database, each with a state folder and DDS ports of its own, and a
/// gateway that names both. Each server has `dripline.server=a|b` in its sessions. Failures are
/// reported through gtest assertions.
class TwoServers {
 public:
  struct Options {
    std::array<std::string, 2> stores;  ///< URL of the database for each
    std::string speed = "20x";
    std::vector<std::string> arguments = {};         ///< of both servers
    std::vector<std::string> second_arguments = {};  ///< of the second one
    /// Where gateways reach them, and by which interface of theirs. The gateway has the second
    /// one's.
    std::array<std::string, 2> addresses = {"127.0.0.1", "127.0.0.1"};
    std::string interface = "lo";
    std::string first_network = {};  ///< namespace of the first one; empty: the caller's
  };
  explicit TwoServers(Options options);

  /// Starts it, and waits until it says that it listens or stands by.
  void start(int server);
  /// The second folder gets what two servers have in common.
  void share_keys();
  void start_gateway();
  /// SIGSTOP and SIGCONT; a frozen server is asked nothing.
  void freeze(int server);
  void thaw(int server);
  bool wait_for_standby(std::chrono::milliseconds limit = std::chrono::seconds(30)) const;
  /// Waits until it is the active one.
  bool wait_active(int server, std::chrono::milliseconds limit = test_support::kPatience) const;
  bool wait_connected(int server, std::chrono::milliseconds limit = std::chrono::seconds(30)) const;
  /// -1: none, or both.
  int active() const;
  std::string role(int server) const;

  test_support::ChildProcess& server(int number) { return *servers_[at(number)]; }
  test_support::ChildProcess& gateway() { return *gateway_; }
  test_support::RestClient rest(int server) const;
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path state(int server) const { return folder() / name(server); }
  std::string output(int server) const;
  std::string log(int server) const;
  std::string gateway_log() const;
  std::uint16_t dds_port(int server) const;
  int domain() const { return domain_; }
  const std::string& tag() const { return tag_; }
  std::filesystem::path gateway_state() const { return folder() / "gateway"; }

  void push(int server, const std::string& name, const std::string& text,
            const std::string& control = "centurion") const;

 private:
  static std::size_t at(int server) { return static_cast<std::size_t>(server); }
  std::vector<std::string> network_arguments() const;
  static std::string name(int server) { return server == 0 ? "a" : "b"; }

  test_support::TemporaryFolder folder_;
  Options options_;
  int domain_ = 0;
  std::optional<FileLock> domain_lock_;
  std::string tag_;
  std::array<std::optional<test_support::ChildProcess>, 2> servers_;
  std::array<std::uint16_t, 2> http_ports_{};
  std::array<bool, 2> is_frozen_{};
  std::optional<test_support::ChildProcess> gateway_;
};

/// The level of the gateway's program text, sampled through the machine's own panel, so that no
/// server is needed.
class TextLevel {
 public:
  explicit TextLevel(std::filesystem::path gateway_state);
  ~TextLevel();
  struct Range {
    std::uint64_t least = UINT64_MAX, most = 0;
    std::uint64_t samples = 0;
    bool has_ended = false;  ///< no run was active at a sample
  };
  Range now() const;
  void reset();

 private:
  struct Sampler;
  std::unique_ptr<Sampler> sampler_;
};

}  // namespace dripline::integration
