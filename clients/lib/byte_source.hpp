#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline::client {

/// Bytes that can be read again from any offset, as a resumed push needs. One thread at a time.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  /// Fills all of `into` from `offset`. Errors: Io (also when the bytes end before that).
  virtual Result<void> read(std::uint64_t offset, std::span<char> into) = 0;
};

/// A regular file. A push sends the size that the file had when it was opened: a file that shrinks
/// meanwhile is an error, one that grows is cut at its old size.
class FileSource final : public ByteSource {
 public:
  /// Errors: Io; Unsupported (not a regular file).
  static Result<FileSource> open(const std::string& path);
  FileSource(FileSource&& other) noexcept;
  FileSource& operator=(FileSource&&) = delete;
  ~FileSource() override;

  std::uint64_t size() const override { return size_; }
  Result<void> read(std::uint64_t offset, std::span<char> into) override;

 private:
  FileSource(std::string path, int descriptor, std::uint64_t size);
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace dripline::client
