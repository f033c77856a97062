#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/event.hpp"
#include "gateway/interpreter/geometry/workpiece.hpp"
#include "gateway/interpreter/interpreter.hpp"
#include "gateway/interpreter/option.hpp"
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
  Position length;  ///< mills: Z; lathes: X and Z
  Position wear;
  Length radius;
  Length radius_wear;
  int tip = 0;  ///< lathe tool type
};

struct OffsetRecord {
  std::string name;
  Position value;
};
struct VariableRecord {
  std::string name;
  double value = 0;
};

/// What a control knows before a program starts. All of it has defaults (spec: trace format, "The
/// setup file").
struct Setup {
  Position start;
  std::optional<Units> units;
  Switches switches;
  std::optional<LocalTime> date_time;
  std::vector<std::string> answers;
  std::vector<ToolRecord> tools;
  std::vector<OffsetRecord> offsets;
  std::vector<VariableRecord> variables;
  Workpiece workpiece;
  Options control;
  std::optional<std::string> library_path;  ///< folder of called programs; resolved by the caller
};

/// Reads a setup file's text; lengths are in the file's `units`, or in `units` when it names none
/// (a dialect's own, see `Dialect::units`). Errors: Syntax, with the key and its line; an unknown
/// key is an error.
Result<Setup> parse_setup(std::string_view toml, Units units = Units::Millimetre);

}  // namespace dripline::interpreter
