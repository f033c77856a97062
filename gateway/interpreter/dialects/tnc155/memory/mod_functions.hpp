#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"

/// What the control's MOD menu holds, as data: kept with a machine's setup, shown, and sent. A
/// program feels the limits only; they, and the size of the memory, are options with names.
namespace dripline::interpreter::tnc155 {

enum class PositionDisplay : std::uint8_t { Actual, Reference, Lag, Nominal, DistanceToGo };
/// As the setup writes them, in the order of PositionDisplay.
inline constexpr std::array<std::string_view, 5> kPositionDisplays{"ACTL", "REF", "LAG", "NOML",
                                                                   "DIST"};

/// A machine parameter that its builder lets the operator set.
struct UserParameter {
  int parameter = 0;  ///< its number, MP
  std::string text;   ///< of the dialog: "USER PAR. 1" and so on where the builder gave none
  double value = 0;
  std::optional<double> min, max;
};

/// Errors: LimitExceeded, with the parameter, the value and its range.
Result<void> check_value(const UserParameter& parameter, double value);
/// "0 to 8", "at least 0", "at most 8"; empty where the builder set no range.
std::string range_text(const UserParameter& parameter);

inline constexpr std::size_t kMaxUserParameters = 16;
inline constexpr std::int64_t kHighestIncrement = 99;
/// A limit that lies there limits nothing: no axis goes farther. Millimeters or degrees.
inline constexpr double kFarthestLimit = 30'000;

struct ModSettings {
  Units display_units = Units::Millimeter;
  PositionDisplay position_display = PositionDisplay::Actual;
  bool is_display_large = false;
  int block_increment = 10;      ///< of ISO block numbers; 0: blocks get none
  std::optional<int> baud_rate;  ///< of the control's interface; absent: not stated
  Axis fourth_axis = Axis::C;
  Position limit_low, limit_high;  ///< machine coordinates; of the axes that are marked
  std::string nc_software, plc_software;
  std::vector<UserParameter> user_parameters;
  std::size_t memory_blocks = 3'100;
};

/// Of a setup's `[control]`. Errors: Syntax (the option, its value, what it may be).
Result<ModSettings> read_mod_settings(const Options& options);

/// Those of the setup's `machine_parameters` and of its user parameters: all that the control is
/// known to hold. Errors: as of both.
Result<MachineParameters> all_machine_parameters(const Options& options);

/// A line of the menu.
struct ModFunction {
  std::string name, value, range;
};
/// In the order in which the control pages through them. `vacant`: blocks that are left of the
/// memory.
std::vector<ModFunction> mod_functions(const ModSettings& settings, std::size_t vacant);

/// By its dialog text, its place in the menu (1 to 16), or its machine parameter ("MP173").
/// Errors: NotFound, naming those there are.
Result<std::size_t> find_user_parameter(const ModSettings& settings, std::string_view name);

}  // namespace dripline::interpreter::tnc155
