#pragma once

#include <cstdint>

namespace dripline::interpreter::language {

/// Distinguishes a program that repeats without end and without effect from one that makes part
/// after part: it counts the passes since the machine last moved, dwelt or waited for an answer. (A
/// loop with motion is bounded where programs run offline: clients/tools/offline.)
///
/// Not part of a snapshot: a resumed run counts from 0.
class LoopGuard {
 public:
  static constexpr std::uint64_t kMaxIdlePasses = 1'000'000;

  void note_progress() { idle_passes_ = 0; }
  /// A jump, a repeat or a call. False: too many of them.
  bool count_pass() { return ++idle_passes_ <= kMaxIdlePasses; }

 private:
  std::uint64_t idle_passes_ = 0;
};

}  // namespace dripline::interpreter::language
