#pragma once

#include <optional>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::cli {

/// Standard output for content of any length: unbuffered, and it notices when there is no reader
/// any more. After a failed write nothing more is written.
class StandardOutput {
 public:
  /// Errors: Io.
  Result<void> write(std::string_view text);
  const std::optional<Error>& error() const { return error_; }
  /// The reader has gone (`dnc ... | head`): no error to speak of.
  bool is_closed() const { return is_closed_; }
  /// After a failed write: reports it, unless the reader has gone, and returns the exit status.
  int complain() const;

 private:
  std::optional<Error> error_;
  bool is_closed_ = false;
};

}  // namespace dripline::cli
