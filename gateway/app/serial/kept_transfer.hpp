#pragma once

#include <filesystem>
#include <utility>

#include "gateway/line/port_view.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// What the control may be in the middle of: that it is, whatever was sent, and the last text that
/// went to it without a run, as long as it has not gone through. Its control may still ask for the
/// rest, so it outlives the gateway, however that ends. A file of the state folder. One thread at a
/// time.
class KeptTransfer {
 public:
  explicit KeptTransfer(std::filesystem::path file) : file_(std::move(file)) {}

  /// What was being sent when the gateway was killed is Interrupted, and all of it may have left.
  /// Errors: Io, Corrupt.
  Result<line::LineMemory> read() const;
  /// On disk when it returns. Without anything to remember there is no file. Errors: Io.
  Result<void> write(const line::LineMemory& memory) const;

 private:
  std::filesystem::path file_;
};

}  // namespace dripline::gateway
