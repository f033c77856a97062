#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "server/library/health.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// Whether the archives are there as they were written: each file that the audit trail has an entry
/// of (archive.create), by the SHA-256 in that entry, and the list of archives beside it. Any
/// thread.
class ArchiveCheck {
 public:
  struct Parts {
    const storage::Store& store;
    const Clock& clock;
    std::filesystem::path folder;  ///< of archives
  };
  struct Fault {
    std::string file, what;
  };
  struct State {
    UtcTime at;  ///< of the check of all
    std::uint64_t archives = 0;
    std::vector<Fault> faults;
  };
  explicit ArchiveCheck(Parts parts) : parts_(std::move(parts)) {}

  /// Reads every file. Errors: Busy (another check reads them, or `stop`), those of the store.
  Result<State> check(const std::stop_token& stop = {});
  /// After the first check: finds files that went, or were written to since they were read, and
  /// reads only those. To be called every few seconds.
  Result<void> look();
  /// Absent: not checked yet.
  std::optional<State> state() const;
  /// For the server's health.
  Health::Finding finding() const;

 private:
  /// What a write to a file changes, even one that keeps its size and its time.
  struct Mark {
    std::uint64_t size = 0;
    std::int64_t inode = 0, changed_ns = 0, modified_ns = 0;
    friend bool operator==(const Mark&, const Mark&) = default;
  };
  struct Known {
    Digest sha256;                  ///< by the audit trail
    std::uint64_t entry;            ///< its number
    std::optional<Mark> mark = {};  ///< of the file when it was read
    std::string fault = {};
  };
  std::optional<Mark> mark_of(const std::string& file) const;
  void read(const std::string& file, Known& known) const;
  Result<std::map<std::string, Known>> trail(const std::stop_token& stop) const;
  Result<std::vector<Fault>> compare_list(const std::map<std::string, Known>& known) const;
  void publish(UtcTime at, std::vector<Fault> of_list);

  const Parts parts_;
  std::mutex check_mutex_;              ///< held by the thread that reads files
  std::map<std::string, Known> known_;  ///< by file
  std::vector<Fault> of_list_;
  mutable std::mutex mutex_;
  std::optional<State> state_;
};

}  // namespace dripline::library
