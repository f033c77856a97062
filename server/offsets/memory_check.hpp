#pragma once

#include <optional>
#include <string>

#include "storage/store.hpp"

namespace dripline::offsets {

/// A correction: a machine's newest setup before and after.
struct Correction {
  std::string machine, control;
  std::string target;           ///< T3.wear.X
  std::string before, changed;  ///< texts of the setup
};

/// Why the correction might be another step at the machine than in the setup, and what to do;
/// empty: it is the same. A control that keeps its own number of the value
/// (deploy/docs/control-memory.md) would go from that number, not from the setup's. Which cells a
/// value has is what the control's interpreter makes of both texts. In doubt there is a reason.
/// Errors: those of the store and of the control.
Result<std::string> doubt_of_step(const storage::Store& store, const Correction& correction);

/// The same where the correction is applied at once: what an active run changes is only known at
/// its end.
Result<std::string> doubt_at_approval(const storage::Store& store, const Correction& correction);

/// Until when the control's memory had another number of the target than the setup: what was
/// measured before may have been cut under that. Of kMemoryReportsBack reports; what was before
/// them, or cannot be read, is a doubt. Nothing: at no time. `changed` is not used. Errors: those
/// of the store and of the control.
Result<std::optional<UtcTime>> differed_until(const storage::Store& store,
                                              const Correction& correction);

inline constexpr std::uint64_t kMemoryReportsBack = 100;

}  // namespace dripline::offsets
