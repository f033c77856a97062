#pragma once

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/stages/tilting/kinematics.hpp"

/// The options of `[control]` that describe a five-axis machine.
namespace dripline::interpreter::tilting {

/// `kinematics` comes first; without it none of the others may be there.
inline constexpr std::array kKinematicKeys{
    option(
        "kinematics", "none|table-table|head-table|head-head",
        "what the rotary axes turn; other than none, tilted planes and tool center point control "
        "are known"),
    option(
        "rotary_master", "A+|A-|B+|B-|C+|C-",
        "the rotary axis that carries the other one, of a head and a table the head's; +: positive "
        "angles turn the table or the tool counterclockwise, seen from the positive end",
        "needed with kinematics"),
    option("rotary_slave", "A+|A-|B+|B-|C+|C-", "the other rotary axis", "needed with kinematics"),
    option("table_centers", kAxisTables,
           "a point on the axis of each rotary table, the master's first, in machine coordinates "
           "with both axes at 0",
           "needed with tables"),
    option(
        "head_centers", kAxisTables,
        "from the spindle's gauge point to a point on the axis of each rotary head, the master's "
        "first, with both axes at 0",
        "needed with heads"),
    option("rotary_limits", kAxisTables,
           "lowest and highest machine coordinate of the rotary axes"),
    option("tip_tolerance", kLength,
           "how far the tip may be off its path in tool center point control, and off an arc in a "
           "tilted plane",
           "0.005 mm"),
    option(
        "table_frame", "zero|start",
        "tool center point control takes the datum as that of the table at its zero, or as it is "
        "when the control begins")};

/// All keys together; they are checked against each other. Errors: Syntax.
Result<void> read_kinematics(const Options& options, const OptionKey& key, Kinematics& machine);

/// The rows of a control that has `kinematics` among its options.
template <class Control>
constexpr auto kinematic_rows() {
  std::array<OptionRow<Control>, kKinematicKeys.size()> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    static_cast<OptionKey&>(rows[i]) = kKinematicKeys[i];
    rows[i].read = nullptr;
  }
  rows[0].read = [](const Options& options, const OptionKey& key, Control& control) {
    return read_kinematics(options, key, control.kinematics);
  };
  return rows;
}

}  // namespace dripline::interpreter::tilting
