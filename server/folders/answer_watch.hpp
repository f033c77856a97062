#pragma once

#include <atomic>
#include <chrono>

#include "protocol/base/clock.hpp"

namespace dripline::folders {

/// For how long a thread has waited for an answer of the file system: a network share that hangs
/// reports nothing itself. One thread waits, any asks; the clock must outlive it.
class AnswerWatch {
 public:
  explicit AnswerWatch(const Clock& clock) : clock_(clock) {}

  /// While it lives, an answer is waited for.
  class Wait {
   public:
    explicit Wait(AnswerWatch& watch) : watch_(watch) { watch_.answered(); }
    ~Wait() { watch_.since_ = kNone; }
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;

   private:
    AnswerWatch& watch_;
  };
  /// A part of it has come: the rest is waited for from now on.
  void answered() { since_ = clock_.steady_now(); }
  /// Zero: no answer is waited for.
  std::chrono::seconds silence() const {
    const SteadyTime since = since_;
    if (since == kNone) return {};
    return std::chrono::duration_cast<std::chrono::seconds>(clock_.steady_now() - since);
  }

  /// A share that does not answer for so long hangs, for people.
  static constexpr std::chrono::seconds kPatience{10};

 private:
  static constexpr SteadyTime kNone = SteadyTime::min();
  const Clock& clock_;
  std::atomic<SteadyTime> since_ = kNone;
};

}  // namespace dripline::folders
