#pragma once

#include <cstdint>
#include <span>

namespace dripline::interpreter::tnc155::itnc {

/// What a Q parameter of a cycle means: its unit, and what it may be.
enum class CycleUse : std::uint8_t {
  Length,    ///< a coordinate, or a distance of any sign
  Distance,  ///< not negative
  Feed,
  Seconds,
  Number,
  Zero,  ///< only 0 is taken: what other values do is not known well enough
};

struct CycleParameter {
  std::int16_t q;
  CycleUse use;
  bool is_needed = true;  ///< older controls of the family have not all; absent it is 0
};

/// Point patterns, which call the cycle that was defined before them.
inline constexpr int kPolarPattern = 220, kCartesianPattern = 221;
constexpr bool is_pattern(int cycle) {
  return cycle == kPolarPattern || cycle == kCartesianPattern;
}

/// A machine builder's, how the axes are tuned: it moves nothing and leaves the cycle of a call.
inline constexpr int kTuning = 392;
inline constexpr int kRetractionFeed = 208;
/// What a parameter holds whose feed is FMAX.
inline constexpr double kRapidFeed = 99'999;

/// The parameters of a cycle; empty: it is none of those that are known.
std::span<const CycleParameter> cycle_table(int cycle);
/// Of `values`, which are in the order of `rows`; 0 for a parameter that is not among them.
double value_of(std::span<const CycleParameter> rows, std::span<const double> values, int q);

}  // namespace dripline::interpreter::tnc155::itnc
