#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::client {

/// A file that appears under its name only when it is complete: written beside it, synced, then
/// renamed. Destroyed without `commit`, it leaves nothing. One thread at a time.
class OutputFile {
 public:
  /// Errors: Io, naming `path`.
  static Result<OutputFile> create(const std::string& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  Result<void> write(std::string_view bytes);
  /// Where the bytes are before `commit`.
  const std::string& temporary_path() const { return temporary_; }
  /// After success the file is on disk under its name. Errors: Io.
  Result<void> commit();

 private:
  OutputFile(std::string path, std::string temporary, int descriptor);
  std::string path_, temporary_;
  int descriptor_ = -1;
};

}  // namespace dripline::client
