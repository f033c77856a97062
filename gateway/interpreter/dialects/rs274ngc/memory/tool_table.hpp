#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// The tool table, and what G10 does to it (LinuxCNC, as measured). It begins as the setup has it;
/// what a program writes holds for the rest of the run. A length in force changes with the next
/// G43.
namespace dripline::interpreter::rs274ngc {

/// The row of a tool, or nullptr.
const Tool* find_tool(const Run& run, int number);
/// That of an H or D word, which is whole and not negative. To LinuxCNC 0 is the tool in the
/// spindle; the NIST program looks for a slot 0.
const Tool* find_tool_of_word(const Run& run, double number);

/// G10 L1: the words are the row's values. L10: the lengths that make the words the coordinates of
/// where the tool is; L11: the same in G59.3, without G92. R is the radius, I and J the angles, Q
/// the orientation of a lathe tool.
bool write_tool(Run& run, int l);
/// G10 L0. The control's file holds what has been written, so that reading it changes nothing; it
/// is refused while a tool is loaded.
bool reload_tools(Run& run);

}  // namespace dripline::interpreter::rs274ngc
