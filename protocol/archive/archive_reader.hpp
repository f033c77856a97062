#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "protocol/archive/archive_writer.hpp"

namespace dripline::archive {

/// Gives the next bytes of a file; empty at its end. Errors: Io.
using Bytes = std::function<Result<std::span<const std::byte>>()>;

/// Takes a row; an error ends the reading.
using RowVisitor = std::function<Result<void>(const std::string& row)>;

/// An archive's rows in their order. Errors of everything: Io, Syntax (it is no archive),
/// Unsupported (of a newer version), Corrupt (cut off or changed), LimitExceeded (a line).
class ArchiveReader {
 public:
  static Result<ArchiveReader> open(const std::string& file);
  /// For tests, and for other sources of bytes.
  static Result<ArchiveReader> begin(Bytes bytes, std::string name);
  ArchiveReader(ArchiveReader&&) noexcept;
  ~ArchiveReader();

  const Head& head() const;
  /// nullopt after the last row; only then it is known that nothing was changed or cut off.
  Result<std::optional<std::string>> next();
  /// All of them that are left. Errors: those of `visit`.
  Result<void> each(const RowVisitor& visit);
  /// Of the bytes so far; after the last row, of the file.
  Digest sha256() const;

 private:
  struct Stream;
  explicit ArchiveReader(std::unique_ptr<Stream> stream);
  Result<std::optional<std::string>> line();
  Result<void> fill();
  std::unique_ptr<Stream> stream_;
};

}  // namespace dripline::archive
