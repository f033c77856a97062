#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "storage/page.hpp"

namespace dripline::storage {

enum class FolderFileState : std::uint8_t {
  Taken,   ///< read; its revision is not stored yet
  Stored,  ///< as a revision
  Failed,  ///< refused, for a reason
};
std::string_view to_string(FolderFileState state);
/// Errors: Syntax.
Result<FolderFileState> parse_folder_file_state(std::string_view text);

/// A file of a hot folder, and what became of it.
struct FolderFile {
  std::uint64_t id = 0;  ///< the store gives it
  std::string folder, name;
  Digest sha256;
  std::uint64_t size = 0;
  std::int64_t changed_ns = 0;  ///< its time of change
  FolderFileState state = FolderFileState::Taken;
  std::string program;         ///< Stored: its name then
  std::uint64_t revision = 0;  ///< Stored
  std::string reason;          ///< Failed
  std::string target;          ///< where it is moved, below the folder; empty: not chosen yet
  UtcTime taken;
  std::optional<UtcTime> moved;  ///< absent: it is still in its folder

  /// Whether it is the file with these facts, and not a later one of the same name.
  bool is_same(const Digest& digest, std::int64_t changed) const {
    return sha256 == digest && changed_ns == changed;
  }
};

struct FolderCounts {
  std::uint64_t stored = 0, failed = 0;
};

/// The files of hot folders. Promises of every store: storage/store.hpp.
class FolderStore {
 public:
  virtual ~FolderStore() = default;

  /// Files that are still in their folder, oldest first.
  virtual Result<std::vector<FolderFile>> unfinished(const std::string& folder) = 0;
  virtual Result<std::optional<FolderFile>> unfinished(const std::string& folder,
                                                       const std::string& name) = 0;
  /// A file that is Taken or Failed. One of its folder and name that was taken, but never stored,
  /// is replaced. Errors: Conflict (such a file is stored or failed, and not moved yet).
  virtual Result<FolderFile> begin(const FolderFile& file) = 0;
  /// Errors: NotFound (it is not Taken).
  virtual Result<void> fail_file(std::uint64_t id, const std::string& reason) = 0;
  virtual Result<void> set_target(std::uint64_t id, const std::string& target) = 0;
  /// It is not in its folder any more. Rows of moved files are dropped after kKept newer ones.
  virtual Result<void> set_moved(std::uint64_t id, UtcTime time) = 0;
  /// Newest first; without a name of all folders.
  virtual Result<std::vector<FolderFile>> list(const std::optional<std::string>& folder,
                                               Page page) = 0;
  /// Of the files that are kept.
  virtual Result<FolderCounts> counts(const std::string& folder) = 0;

  static constexpr std::uint64_t kKept = 10'000;
};

}  // namespace dripline::storage
