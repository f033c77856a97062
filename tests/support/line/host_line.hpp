#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/serial/line_driver.hpp"

namespace dripline::test_support {

/// The host's end of a line, in the hands of a test: sends texts, keeps what comes. Any thread.
class HostLine {
 public:
  HostLine(const std::string& address, const wire::LineSettings& settings);
  ~HostLine();

  /// One transfer; waits for nothing.
  void send(std::string text, std::string name = "");
  void abort();
  /// Expects a transfer, where the protocol needs a command for that.
  void receive();
  /// Sends this when the other end asks for a program, once.
  void answer_with(std::string text);

  std::string received() const;       ///< of all transfers
  std::string last_received() const;  ///< of the last complete one
  bool is_open() const { return line_->is_open(); }
  bool is_stopped() const { return line_->state().is_stopped; }
  bool is_idle() const;        ///< everything sent, or failed
  std::uint64_t sent() const;  ///< characters on the line
  std::vector<std::string> failures() const;
  std::vector<wire::TransferRequest> requests() const;
  std::size_t transfers_received() const;

 private:
  void on_event(wire::Event& event);
  void pump(wire::Discipline& end, wire::LineTime now);

  mutable std::mutex mutex_;
  std::string answer_, text_, name_, received_, receiving_, last_received_;
  bool is_begun_ = false, is_sending_ = false;
  std::uint64_t sent_ = 0;
  std::size_t transfers_received_ = 0;
  std::vector<std::string> failures_;
  std::vector<wire::TransferRequest> requests_;
  std::unique_ptr<serial::LineDriver> line_;
};

}  // namespace dripline::test_support
