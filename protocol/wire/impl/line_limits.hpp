#pragma once

#include <cstddef>

/// What settings may say at most, and what one end of a line keeps at most.
namespace dripline::wire {

inline constexpr unsigned kMinimumBaud = 50;
inline constexpr unsigned kMaximumBaud = 4'000'000;
inline constexpr unsigned kMaximumBlank = 10'000;     ///< leader, trailer
inline constexpr unsigned kMaximumWait = 86'400'000;  ///< a day, in milliseconds
inline constexpr unsigned kMaximumRetries = 100;
inline constexpr unsigned kMaximumBufferSize = 65'536;

/// A received block that is longer is said to be wrong.
inline constexpr std::size_t kLongestBlock = 1024;
/// Text offered that has not left yet.
inline constexpr std::size_t kTextQueueSize = std::size_t{64} * 1024;
/// Control characters of our own that have not left yet; more are only asked for by a line that
/// talks nonsense.
inline constexpr std::size_t kControlQueueSize = 256;

}  // namespace dripline::wire
