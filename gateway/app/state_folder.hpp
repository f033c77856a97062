#pragma once

#include <filesystem>
#include <utility>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// A gateway's own folder: one process at a time.
class StateFolder {
 public:
  /// Creates it when there is none, for its owner alone; closes it to others. Errors: Busy (naming
  /// the owner's process id), Denied, Io.
  static Result<StateFolder> open(const std::filesystem::path& folder);

  std::filesystem::path outbox() const { return folder_ / kOutbox; }
  std::filesystem::path journal() const { return folder_ / kJournal; }
  std::filesystem::path motion_journal() const { return folder_ / kMotionJournal; }
  std::filesystem::path recordings() const { return folder_ / "recordings"; }
  std::filesystem::path uploads() const { return folder_ / "uploads"; }
  std::filesystem::path kept_transfer() const { return folder_ / "line-transfer.json"; }
  std::filesystem::path line_doubt() const { return folder_ / "line-text-open"; }
  std::filesystem::path emergency_stop() const { return folder_ / "emergency-stop"; }

 private:
  static constexpr const char* kOutbox = "outbox.sqlite";
  static constexpr const char* kJournal = "run.journal";
  static constexpr const char* kMotionJournal = "motion.journal";
  StateFolder(std::filesystem::path folder, FileLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  std::filesystem::path folder_;
  FileLock lock_;
};

}  // namespace dripline::gateway
