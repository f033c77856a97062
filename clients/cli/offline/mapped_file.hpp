#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::cli {

/// A file's bytes without reading them in: programs of many gigabytes cost no memory. Read-only;
/// any thread. A file that is cut short while it is mapped ends the process (SIGBUS).
class MappedFile {
 public:
  /// Errors: Io, Unsupported (a folder or device); both name the path.
  static Result<MappedFile> open(const std::string& path);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&&) = delete;
  ~MappedFile();

  std::string_view text() const { return {data_, size_}; }

 private:
  MappedFile(const char* data, std::size_t size) : data_(data), size_(size) {}
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace dripline::cli
