#pragma once

#include "server/offsets/offsets.hpp"
#include "server/offsets/rule_check.hpp"

namespace dripline::offsets {

/// The value has its rule's digits already; zeros at the end are not written.
inline constexpr int kDecimals = 9;

/// A machine as it is now.
struct Offsets::Current {
  std::string machine, control, text, unit;
  std::uint64_t setup = 0;  ///< 0: there is none
  /// Which one is in a control that is loaded by hand, as it was stated; nothing: it never was.
  std::optional<storage::LoadedSetup> loaded = {};
  SetupText place() const { return {machine, setup, text}; }
};

}  // namespace dripline::offsets
