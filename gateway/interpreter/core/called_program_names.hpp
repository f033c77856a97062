#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dripline::interpreter {

/// The names under which a program that another one calls by `name` may be kept, in a folder as in
/// the server's library, the most literal first: O0002 may be O0002, O0002.nc, O2.ngc, 2.h ... One
/// list for all, so that a check offline finds the text that a run will use. `name` is
/// the control's ("O0002", "2", "pocket"); the list is empty for names that no program may have,
/// such as those that would leave the folder.
std::vector<std::string> called_program_names(std::string_view name);

}  // namespace dripline::interpreter
