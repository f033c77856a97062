#pragma once

#include <array>
#include <span>
#include <string_view>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"

/// The rest of the AXIS and POWER pages (manual: set-up pages POWER and AXIS): what tunes drives
/// and describes the machine. They are data, checked and kept with the setup as
/// `[control.machine]`; the interpreter uses only `no_canned_cycles` and `atc_pockets`. The pages'
/// other rows are options of their own (options.hpp).
namespace dripline::interpreter::centurion {

struct MachineParameter {
  std::string_view name;   ///< in `[control.machine]`
  std::string_view page;   ///< AXIS or POWER
  std::string_view title;  ///< the page's words
  int number = 0;          ///< P...; of an axis parameter Z, X is the next
  bool is_per_axis = false;
  bool is_length = false;  ///< in the setup's units, or those per minute
  bool is_whole = false;
  double low = 0, high = 0;
  int count() const { return is_per_axis ? 2 : 1; }
};
inline constexpr int kNoCannedCycles = 904;
inline constexpr int kAtcPockets = 905;
inline constexpr int kLastMachineParameter = 908;

/// In the order of their numbers.
std::span<const MachineParameter> machine_parameters();

/// `[control.machine]` into the parameters. Errors: Unsupported (no such parameter), Syntax (of the
/// wrong kind), LimitExceeded, naming the parameter, its value and its range.
Result<void> load_machine_parameters(const Options& options, Parameters& parameters);

/// Where a changer has each tool, 1 to 24; its own number unless the setup gives another pocket; 0:
/// in none. Without pockets all are 0. Errors: LimitExceeded, Syntax (two tools in one pocket).
using Pockets = std::array<int, kOffsetCount + 1>;
Result<Pockets> read_pockets(const Setup& setup, int pocket_count);

}  // namespace dripline::interpreter::centurion
