#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/rest_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::integration {

/// The real programs in a folder of their own: one server, one or more gateways, on loopback, with
/// a DDS domain and tag that no other test uses. Every start waits until the program answers.
/// Failures are reported through gtest assertions.
class System {
 public:
  struct Options {
    std::string speed = "max";
    std::vector<std::string> server_arguments;
    std::vector<std::string> gateway_arguments;
    std::string control = "centurion";                  ///< of gateways and pushed programs
    std::vector<std::string> gateway_environment = {};  ///< NAME=value
    std::string lease_ms = "1000";
  };
  System() : System(Options{}) {}
  explicit System(Options options);

  void start_server();
  void launch_server();  ///< without waiting until it listens
  void start_gateway(const std::string& machine = "lathe-1");
  /// Another gateway that claims the same machine, with a state of its own, beside the first.
  test_support::ChildProcess second_gateway(const std::string& machine = "lathe-1") const;
  void wait_connected(const std::string& machine = "lathe-1");

  /// From its next start on.
  void add_server_argument(std::string argument) {
    options_.server_arguments.push_back(std::move(argument));
  }
  /// Instead of those given before, from its next start on.
  void use_server_arguments(std::vector<std::string> arguments) {
    options_.server_arguments = std::move(arguments);
  }
  /// From the next start of a gateway on.
  void use_gateway_arguments(std::vector<std::string> arguments) {
    options_.gateway_arguments = std::move(arguments);
  }
  int domain() const { return domain_; }
  test_support::ChildProcess& server() { return *server_; }
  test_support::ChildProcess& gateway() { return *gateway_; }
  test_support::RestClient rest() const;
  std::string url() const;
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path server_state() const { return folder() / "server"; }

  /// Stores `text` as a new revision of `name`; returns the commit's answer.
  nlohmann::json push(const std::string& name, const std::string& text);
  /// Starts a run and returns its id.
  std::string start_run(const std::string& program, const std::string& machine = "lathe-1");
  nlohmann::json run(const std::string& id) const;
  /// Waits until the run has ended and returns it.
  nlohmann::json wait_ended(const std::string& id,
                            std::chrono::milliseconds limit = test_support::kPatience) const;
  std::vector<std::string> report_lines(const std::string& id) const;
  /// What a restart reports before cycle start; null: nothing yet.
  nlohmann::json restart_report(const std::string& id) const;

  /// What the simulated machine truly did in its last run, from a file that only its lowest level
  /// writes. An effect on disk and a count in memory cannot change at one instant, so the truth
  /// lies between done and begun.
  struct ExecutionProbe {
    std::uint64_t blocks_done = 0, outputs_done = 0;
    std::uint64_t blocks_begun = 0, outputs_begun = 0;
  };
  ExecutionProbe execution_probe() const;

 private:
  void append_network(std::vector<std::string>& command) const;
  std::vector<std::string> gateway_command(const std::string& machine,
                                           const std::string& state) const;

  test_support::TemporaryFolder folder_;
  Options options_;
  int domain_ = 0;
  std::optional<FileLock> domain_lock_;  ///< no other test takes the domain while servers restart
  std::string tag_;
  std::optional<test_support::ChildProcess> server_, gateway_;
};

/// A DDS domain that no other test uses while `lock` is held.
int take_domain(std::optional<FileLock>& lock);

/// Where the built programs are, given to ctest by CMake.
std::string program_path(const std::string& name);

}  // namespace dripline::integration
