#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline::identity {

/// What one digest costs to compute.
struct HashingCost {
  std::uint64_t passes = 2;
  std::size_t memory = 64 * 1024 * 1024;  ///< bytes
};

/// Digests of passwords, argon2id. A digest carries its salt and its cost, so that the cost can be
/// raised: `is_outdated` reports which to replace at the next sign-in. At most `at_once` digests
/// are computed at the same time, so that strangers who sign in cannot take all memory, and
/// `waiting` more callers wait for them. Any thread; takes about 0.1 s, so never on one that serves
/// sockets.
class PasswordHasher {
 public:
  struct Options {
    HashingCost cost = {};
    unsigned at_once = 2;
    unsigned waiting = 4;
  };
  explicit PasswordHasher(const Options& options);

  /// Errors: Busy (too many wait already), Io (no memory).
  Result<std::string> hash(const std::string& password);
  /// Whether `digest` is of this password. An empty digest is no password's, and takes as long.
  /// Errors: Busy, Corrupt (no digest, or one that would cost more than kMaxMemory or kMaxPasses).
  Result<bool> verify(const std::string& digest, const std::string& password);
  /// Whether the digest was made with another cost.
  bool is_outdated(const std::string& digest) const;
  /// The largest number of digests computed at the same time so far.
  unsigned peak() const;

  static constexpr std::uint64_t kMaxMemory = 256 * 1024 * 1024;
  static constexpr std::uint64_t kMaxPasses = 16;

 private:
  class Turn;
  const Options options_;
  const std::string nobodys_;  ///< a digest of no password, with our cost
  mutable std::mutex mutex_;
  std::condition_variable freed_;
  unsigned running_ = 0, waiting_ = 0, peak_ = 0;
};

}  // namespace dripline::identity
