#pragma once

#include <string>

#include "protocol/archive/archive_reader.hpp"

namespace dripline::archive {

/// A file that was read to its end before any of its rows is passed on: it is whole and its rows
/// fit its end. Rows are read again for each pass, memory does not grow with them. Who writes a
/// whole new file can make it fit; only the SHA-256 in the server's list and in the audit trail
/// shows that.
class VerifiedArchive {
 public:
  /// Errors: those of ArchiveReader.
  static Result<VerifiedArchive> open(const std::string& file);
  const Head& head() const { return head_; }
  const Digest& sha256() const { return sha256_; }
  std::uint64_t rows() const { return rows_; }
  /// Every row in order. Errors: those of `visit`, Corrupt (the file was changed since `open`).
  Result<void> each(const RowVisitor& visit) const;

 private:
  struct Source;
  VerifiedArchive() = default;
  Result<void> read(const RowVisitor& visit, Digest& digest) const;

  std::string name_;
  std::shared_ptr<Source> source_;  ///< the open file: another one of its name does not matter
  Head head_;
  Digest sha256_;
  std::uint64_t rows_ = 0;
};

}  // namespace dripline::archive
