#pragma once

#include <string>
#include <string_view>

#include "gateway/interpreter/core/setup.hpp"

/// The files in which LinuxCNC keeps what a setup has: its tool table (tool.tbl) and its parameter
/// file (.var). Neither says its unit; it is that of the machine (LINEAR_UNITS of the ini file).
/// LinuxCNC user manual, "Tool Table" and "Parameters".
namespace dripline::interpreter::rs274ngc {

/// By the first row. T and P are in each, D, lengths X to W, I and J (angles of a lathe tool) and Q
/// (its tip) may be; a `;` begins a remark.
bool is_tool_table(std::string_view text);
/// By the first line: a number and its value.
bool is_parameter_file(std::string_view text);

/// The text of a setup with what these files have; each may be empty. G92 values that the file says
/// are not in force are left out, with a remark in the text. Errors: Syntax (with file and line),
/// and those of load_memory.
Result<std::string> setup_of_table_files(std::string_view tool_table,
                                         std::string_view parameter_file, Units units);

/// In the setup's units. Errors: those of read_options and load_memory.
Result<std::string> write_tool_table(const Setup& setup);
/// With every parameter that LinuxCNC needs in the file, and the setup's variables from #31 on.
Result<std::string> write_parameter_file(const Setup& setup);

}  // namespace dripline::interpreter::rs274ngc
