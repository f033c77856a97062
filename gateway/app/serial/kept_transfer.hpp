#pragma once

#include <filesystem>
#include <optional>
#include <utility>

#include "gateway/line/port_view.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// The last text that went to the control without a run, as long as it has not gone through: its
/// control may still wait for the rest, so it outlives the gateway. A file of the state folder. One
/// thread at a time.
class KeptTransfer {
 public:
  explicit KeptTransfer(std::filesystem::path file) : file_(std::move(file)) {}

  /// What was being sent when the gateway was killed is Interrupted, and all of it may have left.
  /// Errors: Io, Corrupt.
  Result<std::optional<line::PortTransfer>> read() const;
  /// On disk when it returns. Without a transfer there is none. Errors: Io.
  Result<void> write(const std::optional<line::PortTransfer>& transfer) const;

 private:
  std::filesystem::path file_;
};

}  // namespace dripline::gateway
