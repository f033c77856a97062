#pragma once

#include <vector>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/rs274ngc/memory/parameters.hpp"
#include "gateway/interpreter/dialects/rs274ngc/options.hpp"

/// What the control keeps when a program is over (NIST 3.2.1). In its parameter file: the
/// points of G28 and G30, G92, the coordinate systems, and of the free parameters those that the
/// file lists, here the setup's variables; all others from #31 up until power off. Its tool table:
/// what G10 has written.
namespace dripline::interpreter::rs274ngc {

inline constexpr int kFirstFree = 31;   ///< #1 to #30 are a subprogram's own
inline constexpr int kLastFree = 5060;  ///< from here on the control's own results
inline constexpr int kFirstInFile = kHome;
inline constexpr int kLastInFile = kFirstSystem + kSystems * kParametersPerSystem - 11;  ///< 5390

template <class AnyTools, class Visit>
void for_each_tool_cell(AnyTools& tools, Visit visit) {
  for (auto& tool : tools) {
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      visit(CellName{"tool.", tool.number, kAxisSuffixes[axis]}, tool.length[axis]);
    }
    visit(CellName{"tool.", tool.number, ".diameter"}, tool.diameter);
    visit(CellName{"tool.", tool.number, ".front_angle"}, tool.front_angle);
    visit(CellName{"tool.", tool.number, ".back_angle"}, tool.back_angle);
    visit(CellName{"tool.", tool.number, ".orientation"}, tool.orientation);
  }
}

}  // namespace dripline::interpreter::rs274ngc
