#pragma once

#include <filesystem>

#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// A gateway's own folder: one process at a time, told apart by an flock that ends with the
/// process.
class StateFolder {
 public:
  /// Creates it when there is none. Errors: Busy (naming the owner's process id), Io.
  static Result<StateFolder> open(const std::filesystem::path& folder);
  StateFolder(StateFolder&& other) noexcept;
  StateFolder& operator=(StateFolder&&) = delete;
  ~StateFolder();

  std::filesystem::path outbox() const { return folder_ / "outbox.sqlite"; }
  std::filesystem::path journal() const { return folder_ / "run.journal"; }

 private:
  StateFolder(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::filesystem::path folder_;
  int lock_;
};

}  // namespace dripline::gateway
