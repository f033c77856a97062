#pragma once

#include <cstdint>
#include <filesystem>

#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// For tests that kill the gateway: what the machine really did in its last run, in a memory-mapped
/// file that the gateway itself never reads. An effect on disk and a counter
/// in memory cannot change at one instant, so each count is kept twice: `done` after the effect,
/// `begun` before it; a kill between the two leaves the truth at one or the other. Layout: four
/// 64-bit words in host order, as in Counts.
class ExecutionProbe {
 public:
  struct Counts {
    std::uint64_t blocks_done = 0, outputs_done = 0;
    std::uint64_t blocks_begun = 0, outputs_begun = 0;
  };
  /// Without a file: counts nothing.
  ExecutionProbe() = default;
  /// Errors: Io.
  static Result<ExecutionProbe> open(const std::filesystem::path& file);
  ExecutionProbe(ExecutionProbe&& other) noexcept;
  ExecutionProbe& operator=(ExecutionProbe&&) = delete;
  ~ExecutionProbe();

  void reset();
  /// Up to this block, and this many outputs, is about to become executed.
  void begin(std::uint64_t block, std::uint64_t outputs);
  void finish();

 private:
  explicit ExecutionProbe(Counts* counts) : counts_(counts) {}
  Counts* counts_ = nullptr;  ///< mapped
};

}  // namespace dripline::gateway
