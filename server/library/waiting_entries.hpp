#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "storage/audit_store.hpp"

namespace dripline::library {

/// Audit entries of what has been done already and that the store does not have yet, each as a file
/// of its own on the server's disk: a server that is killed meanwhile finds them when it begins
/// again. A kill between the store and the file says an entry twice, and never not at all. Any
/// thread, one server.
class WaitingEntries {
 public:
  /// Made when the first entry waits.
  explicit WaitingEntries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// On the disk when it returns. Returns its name. Errors: Io.
  Result<std::string> keep(const storage::AuditEntry& entry);
  /// The store has it.
  void drop(const std::string& name) const;

  struct Kept {
    std::string name;
    storage::AuditEntry entry;
  };
  struct Read {
    std::vector<Kept> kept;    ///< in the order in which they were kept
    std::size_t failures = 0;  ///< what cannot be read: logged, and left where it is
  };
  Read read() const;

 private:
  const std::filesystem::path folder_;
  std::atomic<std::uint64_t> last_{0};
};

}  // namespace dripline::library
