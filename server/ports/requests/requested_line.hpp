#pragma once

#include <functional>
#include <string>

#include "server/machines/machine_control.hpp"
#include "server/ports/line_types.hpp"

namespace dripline::ports {

/// A line at whose end an operator requests something, as far as the answers need it: a port of
/// this server, or a gateway's own.
class RequestedLine {
 public:
  using Started = std::function<void(const Result<storage::Run>&)>;
  virtual ~RequestedLine() = default;
  /// To monitors of the line.
  virtual void note(const std::string& words) = 0;
  /// Refuses what the protocol asked for; empty: no program is left.
  virtual void refuse(const std::string& why) = 0;
  /// Whether the control waits for an answer of its protocol's request.
  virtual bool is_asked() const = 0;
  /// Whether the control is known to be in no program that was broken off. Errors: those of
  /// ResetGate::check.
  virtual Result<void> check_reset() const = 0;
  /// Takes the program that the control is about to send.
  virtual void accept_receive(const std::string& name) = 0;
  /// Sends an answer; what becomes of it is logged.
  virtual void send(SendJob job) = 0;
  /// `request.given`: when a text of the control asked for it; absent: its protocol does, and it
  /// waits for the answer. `wire_name`: what the control calls the program; empty: as the library
  /// does. `started` is called later, where the requests are handled.
  virtual void start_later(const machines::StartRequest& request, Started started,
                           const std::string& wire_name) = 0;
};

}  // namespace dripline::ports
