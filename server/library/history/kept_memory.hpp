#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "storage/store.hpp"

namespace dripline::library {

/// One thing that a machine's control keeps when a program is over.
struct KeptCell {
  std::optional<double> value;  ///< none: vacant
  std::optional<double> base;   ///< what the setup gave it
  friend bool operator==(const KeptCell&, const KeptCell&) = default;
};

/// What an operator has set from the position of a machine at rest.
struct MemoryChange {
  std::string what;  ///< interpreter::PositionSetting: "datum G54 X 12.5 mm"
  std::string by;
  std::map<std::string, std::pair<std::optional<double>, double>> cells;  ///< before, and after
  std::string unit = {};              ///< of these: mm, in, deg; empty: an older gateway
  std::optional<double> length = {};  ///< of the tool in force along the axis; none: not known
  std::optional<double> zero = {};    ///< of the work offset that a length is of
};

/// Everything a control kept after a run, as its gateway reported it.
struct KeptMemory {
  std::string machine, run;
  std::optional<std::string> program;  ///< none: the run was begun at the machine
  UtcTime time;                        ///< of the report, at the gateway
  std::map<std::string, KeptCell> cells;
  std::optional<MemoryChange> change = {};  ///< `run` names it then
};

/// Reads the texts of one report, which come in parts. Errors: Syntax, LimitExceeded (no record is
/// so long), NotFound (a part is missing).
Result<std::map<std::string, KeptCell>> read_memory_texts(const std::vector<std::string>& texts);

/// Of the same texts; none: they are those of a run's end.
std::optional<MemoryChange> read_memory_change(const std::vector<std::string>& texts);

/// Newest first; what cannot be read is left out. With `run` after this one alone. Errors:
/// NotFound (it has left nothing, or not all parts of it), those of the store.
Result<std::vector<KeptMemory>> kept_memories(const storage::Store& store,
                                              const std::string& machine,
                                              const std::optional<std::string>& run,
                                              storage::Page page);

}  // namespace dripline::library
