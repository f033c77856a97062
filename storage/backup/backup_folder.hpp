#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "storage/backup/chunk_files.hpp"
#include "storage/backup/manifest.hpp"
#include "storage/backup/retention.hpp"

namespace dripline::backup {

enum class Phase { Copying, Checking, Storing, Verifying, Restoring };
/// copying, checking, storing, verifying, restoring
std::string_view to_string(Phase phase);

/// Bytes of the phase. What it returns: false ends the work.
using Watch = std::function<bool(Phase phase, std::uint64_t done, std::uint64_t total)>;

/// What is backed up: a state folder in use.
struct Source {
  std::filesystem::path folder;
  std::string database;            ///< file name of the database
  std::vector<std::string> files;  ///< others that belong to it; a missing one is left out
  std::string made_by;
  /// Makes a copy of the database as it is now; false: `proceed` ended it.
  std::function<Result<bool>(const std::filesystem::path& copy,
                             const std::function<bool(std::uint64_t, std::uint64_t)>& proceed)>
      copy;
};

struct Backup {
  std::string id;  ///< the time it was made, as 20261123T225935Z
  UtcTime made;
  std::string made_by;
  std::string database;
  std::uint64_t size = 0;                ///< bytes of its files
  std::uint64_t added = 0;               ///< bytes on the backup's disk that no earlier backup had
  std::optional<UtcTime> verified = {};  ///< when its bytes were last read and found good
};

/// The newest of `backups`, which begin with the oldest, that was made by `now`; none: null. One of
/// a time that has not come is from before the clock was set.
const Backup* newest(std::span<const Backup> backups, UtcTime now);

/// A folder of backups. Each is a whole picture of a state folder at one moment; equal bytes are
/// stored once for all of them, in chunks of 256 KiB, so a backup costs what has changed. One
/// process at a time; one thread at a time.
class BackupFolder {
 public:
  /// Creates the folder, for its owner alone. Errors: Busy (another process uses it), Denied, Io.
  static Result<BackupFolder> open(const std::filesystem::path& path);

  /// A backup counts once this returns: its database was copied as one picture, searched for
  /// damage, stored and synchronized. A kill before leaves nothing that counts. Errors: Corrupt
  /// (the database is damaged: nothing is stored), Conflict (ended by the watch), Io (a full
  /// disk), Busy.
  Result<Backup> make(const Source& source, UtcTime now, const Watch& watch);

  struct List {
    std::vector<Backup> backups;       ///< oldest first
    std::vector<std::string> damaged;  ///< files that are no readable backup, with the reason
  };
  /// Errors: Io.
  Result<List> list() const;

  /// Reads every byte of it. A damaged chunk is removed, so that the next backup stores it again
  /// from the server's files; until then the backups that need it cannot be restored. Errors:
  /// NotFound, Corrupt, Conflict (ended by the watch), Io.
  Result<void> verify(const std::string& id, UtcTime now, const Watch& watch);

  /// Writes its files into `folder`, which must be missing or empty, for its owner alone; and
  /// checks the database. After an error the folder holds nothing. Errors: those of verify, and
  /// Busy (the folder is not empty).
  Result<void> restore(const std::string& id, const std::filesystem::path& folder,
                       const Watch& watch);

  /// Errors: NotFound, Io.
  Result<void> remove(const std::string& id);
  struct Pruned {
    std::size_t backups = 0;
    std::uint64_t bytes = 0;  ///< that became free
  };
  /// Removes what has had its time, then the chunks that no backup needs. With an unreadable
  /// backup in the folder no chunk is removed: it may need them. Errors: Corrupt (that), Io.
  Result<Pruned> prune(const Retention& retention, UtcTime now);

  const std::filesystem::path& path() const { return path_; }

 private:
  BackupFolder(std::filesystem::path path, FileLock lock);
  std::filesystem::path manifest_file(const std::string& id) const;
  std::filesystem::path verified_file(const std::string& id) const;
  Backup described(const std::string& id, const Manifest& manifest) const;
  Result<Manifest> manifest(const std::string& id) const;
  Result<KeptFile> store(const std::filesystem::path& file, std::string name, std::uint64_t& added,
                         const Watch& watch);
  Result<void> write_file(const KeptFile& file, const std::filesystem::path& folder,
                          const std::function<bool(std::uint64_t)>& proceed) const;

  std::filesystem::path path_;
  FileLock lock_;
  ChunkFiles chunks_;
};

}  // namespace dripline::backup
