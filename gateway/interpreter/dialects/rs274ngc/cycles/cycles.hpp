#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Canned cycles (NIST 3.5; LinuxCNC: G73, G74, G76).

namespace dripline::interpreter::rs274ngc {

/// G73, G74, G81 to G89: holes, each a row of steps.
bool execute_cycle(Run& run, int g_code);

// Moves that follow the spindle; thread.cpp.

/// G33: K of travel per revolution. G33.1: there and back, the spindle reversed.
bool synchronized_move(Run& run, int g_code);

/// G76: a thread in many passes, in the ZX plane.
bool thread_cycle(Run& run);

// What the cycles do at a hole, as rows of steps (NIST 3.5; where LinuxCNC differs: as measured).

/// What a cycle does at a hole, one after the other.
enum class Step : std::uint8_t {
  End,
  FeedToBottom,
  FeedToClear,
  FeedToR,
  RapidToClear,
  Dwell,  ///< needs P
  DwellIfGiven,
  SpindleStop,
  SpindleReverse,
  SpindleRestore,
  OperatorStop,
  Peck,      ///< to the bottom in pecks, out of the hole between them; needs Q
  Chip,      ///< the same, but only a little back
  BackBore,  ///< needs I, J, K
};

struct CycleRow {
  std::int16_t code;  ///< tenths
  std::array<Step, 6> steps;

  template <class... Steps>
  constexpr bool has(Steps... any) const {
    return std::any_of(steps.begin(), steps.end(),
                       [=](Step step) { return ((step == any) || ...); });
  }
  constexpr bool needs_p() const { return has(Step::Dwell); }
  constexpr bool uses_spindle() const { return has(Step::SpindleRestore, Step::BackBore); }
};

namespace detail {
using enum Step;
inline constexpr std::array kNist{
    CycleRow{810, {FeedToBottom, RapidToClear}},
    CycleRow{820, {FeedToBottom, Dwell, RapidToClear}},
    CycleRow{830, {Peck, RapidToClear}},
    CycleRow{840,
             {FeedToBottom, SpindleStop, SpindleReverse, FeedToClear, SpindleStop, SpindleRestore}},
    CycleRow{850, {FeedToBottom, FeedToClear}},
    CycleRow{860, {FeedToBottom, Dwell, SpindleStop, RapidToClear, SpindleRestore}},
    CycleRow{870, {BackBore}},
    CycleRow{880, {FeedToBottom, Dwell, SpindleStop, OperatorStop, SpindleRestore}},
    CycleRow{890, {FeedToBottom, Dwell, FeedToClear}}};
/// Where the later program differs.
inline constexpr std::array kLater{
    CycleRow{730, {Chip, RapidToClear}},
    CycleRow{740, {FeedToBottom, SpindleReverse, DwellIfGiven, FeedToClear, SpindleRestore}},
    CycleRow{840, {FeedToBottom, SpindleReverse, DwellIfGiven, FeedToClear, SpindleRestore}},
    CycleRow{850, {FeedToBottom, FeedToR, RapidToClear}}};
}  // namespace detail

/// The row of a cycle's G code, in tenths.
inline const CycleRow& cycle_row(int code, bool is_later) {
  const auto has_code = [code](const CycleRow& row) { return row.code == code; };
  const auto later = std::find_if(detail::kLater.begin(), detail::kLater.end(), has_code);
  if (is_later && later != detail::kLater.end()) return *later;
  const auto nist = std::find_if(detail::kNist.begin(), detail::kNist.end(), has_code);
  return nist == detail::kNist.end() ? detail::kNist[0] : *nist;
}

}  // namespace dripline::interpreter::rs274ngc
