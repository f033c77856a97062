#pragma once

#include <cstddef>

/// Limits of settings, and of the memory of one end of a line.
namespace dripline::wire {

inline constexpr unsigned kMinimumBaud = 50;
inline constexpr unsigned kMaximumBaud = 4'000'000;
inline constexpr unsigned kMaximumBlank = 10'000;     ///< leader, trailer
inline constexpr unsigned kMaximumWait = 86'400'000;  ///< a day, in milliseconds
inline constexpr unsigned kMaximumRetries = 100;
inline constexpr unsigned kMaximumBufferSize = 65'536;

/// A longer received block is an error.
inline constexpr std::size_t kLongestBlock = 1024;
/// Offered text that has not left yet.
inline constexpr std::size_t kTextQueueSize = std::size_t{64} * 1024;
/// Control characters of this end that have not left yet; only a line that carries nonsense would
/// need more.
inline constexpr std::size_t kControlQueueSize = 256;

}  // namespace dripline::wire
