#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "clients/lib/reply.hpp"

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

/// The whole file or none of it. Errors: Io.
Result<void> write_file(const std::string& path, std::string_view bytes);

/// Writes to a file, or to standard output for "-" and "". Gives the exit status.
int write_to(const std::string& path, std::string_view text);

/// The whole file or none of it, piece by piece as `fetch` passes them to its argument. Gives the
/// exit status.
using ContentSink = std::function<bool(std::string_view)>;
int save_content(const std::string& path,
                 const std::function<client::Reply<void>(const ContentSink&)>& fetch);

}  // namespace dripline::cli
