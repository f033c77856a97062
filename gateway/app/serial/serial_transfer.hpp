#pragma once

#include <functional>
#include <string>

#include "gateway/line/line_texts.hpp"
#include "gateway/line/port_line.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::gateway {

/// Texts for the control, programs for its memory and answers to its requests: each comes from the
/// server piece by piece and is sent when all of it is here and is what the server states, so that
/// nothing of the network is felt by the control. One thread.
class SerialTransfer {
 public:
  static constexpr std::size_t kMaxBytes = 16 * 1024 * 1024;
  /// A text whose next piece does not come is dropped for another one after this.
  static constexpr std::chrono::seconds kPatience{30};
  struct Parts {
    const Clock& clock;
    /// Why nothing may be sent to the control now, as the gateway sees it.
    std::function<Result<void>()> check_allowed;
  };
  explicit SerialTransfer(Parts parts) : parts_(std::move(parts)) {}
  /// Before anything else; the line outlives this.
  void use(line::PortLine& port) { port_ = &port; }

  /// Bytes of the text `id` from `offset` on; pieces that are here already change nothing. Errors:
  /// Busy (another text is coming), Conflict (one in front of it is missing), LimitExceeded.
  Result<void> add(const std::string& id, std::uint64_t offset, std::string_view piece);
  /// The whole of it, which is here no more then. Errors: NotFound (no such text), Corrupt.
  Result<std::string> take(const std::string& id, const line::TransferOrder& order);
  /// `answer` is called once, at last when the line has taken it. Errors: those of `take`, of
  /// `check_allowed` and of line::send_programs.
  void send(const std::string& id, const line::TransferOrder& order,
            const line::PortLine::Answer& answer);

 private:
  const Parts parts_;
  line::PortLine* port_ = nullptr;
  std::string id_, text_;
  SteadyTime until_{};
};

}  // namespace dripline::gateway
