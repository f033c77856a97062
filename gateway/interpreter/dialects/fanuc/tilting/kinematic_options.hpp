#pragma once

#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"

/// The options of `[control]` that describe a five-axis machine.
namespace dripline::interpreter::fanuc {

/// All keys below together; they are checked against each other. Errors: Syntax.
Result<void> read_kinematics(const Options& options, const OptionKey& key, ControlOptions& control);

inline constexpr std::array kKinematicRows{
    OptionRow<ControlOptions>{option("kinematics", "none|table-table|head-table|head-head",
                                     "what the rotary axes turn; other than none, G68.2, G53.1 and "
                                     "G43.4 are known"),
                              read_kinematics},
    OptionRow<ControlOptions>{option("rotary_master", "A+|A-|B+|B-|C+|C-",
                                     "the rotary axis that carries the other one, of a head and a "
                                     "table the head's; +: positive angles turn the table or the "
                                     "tool counterclockwise, seen from the positive end",
                                     "needed with kinematics")},
    OptionRow<ControlOptions>{option("rotary_slave", "A+|A-|B+|B-|C+|C-", "the other rotary axis",
                                     "needed with kinematics")},
    OptionRow<ControlOptions>{
        option("table_centers", kAxisTables,
               "a point on the axis of each rotary table, the master's first, "
               "in machine coordinates with both axes at 0",
               "needed with tables")},
    OptionRow<ControlOptions>{
        option("head_centers", kAxisTables,
               "from the spindle's gauge point to a point on the axis of each "
               "rotary head, the master's first, with both axes at 0",
               "needed with heads")},
    OptionRow<ControlOptions>{option("rotary_limits", kAxisTables,
                                     "lowest and highest machine coordinate of the rotary axes")},
    OptionRow<ControlOptions>{option("tip_tolerance", kLength,
                                     "how far the tip may be off its path in G43.4, and off an arc "
                                     "in a tilted plane",
                                     "0.005 mm")},
    OptionRow<ControlOptions>{
        option("table_frame", "zero|start",
               "G43.4 takes the work offset as that of the table at its zero, "
               "or as it is at G43.4")}};

}  // namespace dripline::interpreter::fanuc
