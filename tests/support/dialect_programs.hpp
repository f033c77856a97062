#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/registry.hpp"

namespace dripline::test_support {

/// One program of each control that three axes with feed per minute can execute: lines, arcs, a
/// helix or a repetition where the control has them.
struct DialectProgram {
  std::string_view control, name, text;
};
const std::vector<DialectProgram>& dialect_programs();

/// X, Y, Z, A in mm and degrees at the end of each block, by its number.
using BlockEnds = std::map<std::uint64_t, std::array<double, 4>>;
/// As the simulated machine executes the program; its stops are resumed.
BlockEnds simulated_ends(const DialectProgram& program);

}  // namespace dripline::test_support
