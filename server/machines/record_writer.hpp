#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

#include "storage/record_store.hpp"

namespace dripline::machines {

/// Stores the records of one machine. While the store refuses (a full disk), the caller keeps what
/// it could not store and tries again after a pause that grows from try to try; the log gets one
/// line when that begins and one when it ends. Any thread.
class RecordWriter {
 public:
  static constexpr std::chrono::milliseconds kFirstPause{250};  ///< doubled up to kLongestPause
  static constexpr std::chrono::milliseconds kLongestPause{5000};

  struct Parts {
    storage::RecordStore& store;
    std::string machine;
    std::string consequence;  ///< of a store that refuses, for the log
    /// At every try: why nothing can be stored; empty: it can again.
    std::function<void(const std::string& fault)> on_fault = {};
  };
  explicit RecordWriter(Parts parts) : parts_(std::move(parts)) {}

  /// Promises and errors: RecordStore::store.
  Result<std::uint64_t> store(const storage::RecordBatch& batch);
  /// Before the next try; 0: the last one succeeded.
  std::chrono::milliseconds pause() const;

 private:
  Parts parts_;
  mutable std::mutex mutex_;
  std::chrono::milliseconds pause_{0};
};

/// No later try can store these: something in them is not what a gateway writes.
inline bool is_hopeless(const Error& error) {
  return error.code == Errc::Syntax || error.code == Errc::LimitExceeded;
}

}  // namespace dripline::machines
