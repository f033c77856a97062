#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/library/history/kept_memory.hpp"
#include "server/offsets/setup_value.hpp"
#include "storage/store.hpp"

namespace dripline::offsets {

/// A value of a machine's setup and the time while it was in force.
struct HistoryEntry {
  std::string target, unit;
  double value = 0;
  storage::SetupRevision setup;  ///< that brought it, without its text
  std::optional<storage::OffsetProposal> proposal = {};
  std::vector<storage::Run> runs =
      {};  ///< cut under it, oldest first; at most OffsetHistory::kMaxRuns
  std::uint64_t parts = 0, good = 0;       ///< of these runs, the archived ones too
  std::uint64_t archived = 0;              ///< of the parts, those that are in archives alone
  std::vector<std::string> archives = {};  ///< that have them: their files
  /// Archives that may have parts of these runs, from before their parts were counted.
  std::vector<std::string> uncounted = {};
};

/// What was in force while a run was cut: its setup, for all of its blocks. What the program itself
/// changed is the control's memory (deploy/docs/control-memory.md).
struct InForce {
  storage::Run run;
  std::string unit;
  std::vector<NamedValue> values;
};

/// A datum or a tool's length that an operator has set from the machine's position. It is in the
/// control's memory, not in a setup.
struct MachineChange {
  std::string change;  ///< the report's name
  std::string target;  ///< "G54.X", "T3.Z", "datum.X"
  UtcTime time;
  library::MemoryChange what;
};

/// What values of a machine's setups were, from its setups, runs and proposals. Reads only; any
/// thread.
class OffsetHistory {
 public:
  explicit OffsetHistory(const storage::Store& store) : store_(store) {}

  /// Values of tools and offsets whose name begins with `target` ("T3", "T3.wear.X", "G54"), newest
  /// first; at most as many setups back as the page says. Errors: those of the store.
  Result<std::vector<HistoryEntry>> list(const std::string& machine, const std::string& target,
                                         storage::Page page);
  struct ChangeQuery {
    std::string machine;
    std::string prefix;  ///< of the names that gateways give changes
    std::string target;  ///< as of `list`
  };
  /// Those set at the machine, newest first. Errors: those of the store.
  Result<std::vector<MachineChange>> at_machine(const ChangeQuery& query, storage::Page page);
  /// Errors: NotFound.
  Result<InForce> in_force(const std::string& run);

  static constexpr std::uint64_t kMaxRuns = 1000;

 private:
  Result<void> add_runs(HistoryEntry& entry, std::uint64_t until);
  Result<void> add_parts(HistoryEntry& entry);

  const storage::Store& store_;
};

}  // namespace dripline::offsets
