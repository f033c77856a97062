#pragma once

#include <deque>
#include <map>
#include <mutex>

#include "protocol/base/digest.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::library {

/// Keeps the parameters of a Centurion that are in Dripline's own numbers away from machines: a
/// control reads those numbers as other parameters of its own. Content never changes, so each is
/// read once; the last 16384 verdicts are remembered. Any thread; the store must outlive it.
class ParameterNumbering {
 public:
  explicit ParameterNumbering(storage::ProgramStore& store) : store_(store) {}
  /// Errors: Unsupported (such a text: what it is and what to do), those of read_content.
  Result<void> check(const storage::Revision& revision);

 private:
  static constexpr std::size_t kMaxKnown = 16384;
  Result<bool> is_own(const Digest& content);

  storage::ProgramStore& store_;
  std::mutex mutex_;
  std::map<Digest, bool> known_;
  std::deque<Digest> sequence_;  ///< in which they came
};

}  // namespace dripline::library
