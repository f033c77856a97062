#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/workpiece.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/option.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter {

struct Switches {
  bool block_skip = false;
  bool optional_stop = false;
  bool single_block = false;
  bool dry_run = false;
  std::vector<Axis> mirror;
};

struct ToolRecord {
  int number = 0;
  std::string name;  ///< by which programs may call it, on a control that has such calls
  Position length;   ///< mills: Z; lathes: X and Z
  Position wear;
  Length radius;
  Length radius_wear;
  int tip = 0;                ///< lathe tool type
  std::optional<int> pocket;  ///< its pocket in the tool changer's magazine
  bool is_special = false;    ///< takes its neighbors' pockets too, and keeps its own
};

struct OffsetRecord {
  std::string name;
  Position value;
};
struct VariableRecord {
  std::string name;
  double value = 0;
};

/// The knowledge of a control before a program starts. All members have defaults.
struct Setup {
  Position start;
  /// The place of the machine when a program is resumed in its middle, if not `start`.
  std::optional<Position> position;
  std::optional<Units> units;
  Switches switches;
  std::optional<LocalTime> date_time;
  std::vector<std::string> answers;
  std::vector<ToolRecord> tools;
  std::vector<OffsetRecord> offsets;
  std::vector<VariableRecord> variables;
  Workpiece workpiece;
  Options control;
  /// The text is keyed in at the control (MDI): its end needs no program end, and leaves in force
  /// what is. The owner's; no key of a setup file.
  bool is_mdi = false;
  std::optional<std::string> library_path;  ///< folder of called programs; resolved by the caller
};

/// Reads a setup file's text; lengths are in the file's `units`, or in `units` when it names none
/// (a dialect's own, see `Dialect::units`). Errors: Syntax, with the key and its line; an unknown
/// key is an error.
Result<Setup> parse_setup(std::string_view toml, Units units = Units::Millimeter);

/// The contents of a control's memory, as the server stores them: `units`, `tool`, `offset`,
/// `variable` and `control` of a setup file, and nothing else. The description of the machine
/// (start, probe, answers ...) stays with its gateway. Errors: as parse_setup.
Result<Setup> parse_control_data(std::string_view toml, Units units = Units::Millimeter);
/// Replaces the same tables of `setup` by those of `data`. Its options, if any, replace all
/// options.
void use_control_data(Setup data, Setup& setup);

}  // namespace dripline::interpreter
