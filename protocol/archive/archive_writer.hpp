#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"

namespace dripline::archive {

inline constexpr std::size_t kMaxLine = 1024 * 1024;

struct Head {
  std::string kind;      ///< records, measurements
  std::string machine;   ///< empty: of all
  std::string database;  ///< identity of the server's
  std::string made_by;
};

struct WrittenFile {
  Digest sha256;  ///< of the file
  std::uint64_t bytes = 0, rows = 0;
};

/// Writes beside the file's name; it has its name when all of it is on disk. Without `end` nothing
/// stays.
class ArchiveWriter {
 public:
  /// Errors: Io.
  static Result<ArchiveWriter> begin(const std::filesystem::path& file, const Head& head);
  ArchiveWriter(ArchiveWriter&&) noexcept;
  ~ArchiveWriter();

  /// A row: JSON in one line, without its end. Errors: Io, LimitExceeded.
  Result<void> add(std::string_view row);
  /// Replaces a file of that name. Errors: Io.
  Result<WrittenFile> end();

 private:
  struct File;
  explicit ArchiveWriter(std::unique_ptr<File> file);
  Result<void> line(std::string_view text);
  Result<void> compress(std::string_view text, bool is_last);
  std::unique_ptr<File> file_;
};

}  // namespace dripline::archive
