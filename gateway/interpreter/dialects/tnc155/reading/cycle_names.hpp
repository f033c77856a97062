#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace dripline::interpreter::tnc155 {

/// What the sub-block of a cycle holds.
enum class CycleField : std::uint8_t {
  Name,      ///< the sub-block with the point and 0
  Length,    ///< a value into Block::first: set-up, depth, pecking
  Dwell,     ///< seconds into Block::first
  Feed,      ///< F alone
  Peck,      ///< a value and F
  Side,      ///< an axis word
  FeedTurn,  ///< F and DR
  Radius,
  Shift,  ///< an axis word, may be incremental
  Axes,   ///< axes without values
  Rotation,
  Scale,
  Program,
};

struct CyclePart {
  CycleField field;
  std::string_view word;  ///< as the control writes it; for Name that of the cycle
};

/// The cycles by their numbers.
enum CycleNumber : std::uint8_t {
  kPecking = 1,
  kTapping,
  kSlot,
  kPocket,
  kCircularPocket,
  kDatumShift = 7,
  kMirror,
  kDwell,
  kRotation,
  kScaling,
  kProgramCall
};
inline constexpr int kLastCycle = kProgramCall;

/// The sub-blocks of a cycle, first its name; empty for a number that is no cycle. Of the datum
/// shift all four are listed and the first two are needed.
std::span<const CyclePart> cycle_parts(int cycle);

}  // namespace dripline::interpreter::tnc155
