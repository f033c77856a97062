#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/dds/message.hpp"
#include "protocol/dds/record_text.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::integration {

/// A real gateway that plays a control (a Centurion lathe) at the end of a line, without a server.
/// Failures are reported through gtest assertions.
class LineGateway {
 public:
  struct Options {
    std::string address;
    std::vector<std::string> settings;  ///< key=value
    std::string speed = "max";
    std::vector<std::string> arguments = {};
    bool is_unattended = true;  ///< else as a gateway with a line is by itself
    std::string control = "centurion";
  };
  explicit LineGateway(Options options);
  ~LineGateway();

  /// Runs that have ended, from the log.
  std::size_t runs_ended() const;
  bool wait_ended(std::size_t runs,
                  std::chrono::milliseconds limit = std::chrono::seconds(30)) const;
  bool wait_logged(std::string_view text, std::size_t times = 1) const;
  std::string log() const;
  /// The gateway's state folder, where its panel is.
  std::filesystem::path state() const { return folder_.path() / "gw"; }

  /// Ends the process, by SIGTERM or as a loss of power does, and begins the next one.
  void restart(bool is_killed);
  /// Stops the gateway and reads what it kept for a server.
  const std::vector<dds::Record>& records();
  /// How the runs ended, in order.
  std::vector<dds::RunEndText> endings();
  /// What was printed, to the record.
  std::vector<std::string> outputs();

 private:
  void start();
  std::size_t logged(std::string_view text) const;
  Options options_;
  test_support::TemporaryFolder folder_;
  std::optional<test_support::ChildProcess> gateway_;
  std::optional<std::vector<dds::Record>> records_;
};

}  // namespace dripline::integration
