#pragma once

#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"
#include "gateway/interpreter/dialects/fanuc/state.hpp"

/// What the control keeps when a program is over (16/18 operator's manual: offset memory,
/// custom macro): #500 and up, tool offsets,
/// work offsets, part counters and settings, by battery; #100 and up until power off, where reset
/// (and with it M02 and M30) does not clear them. G52, G92 and locals are not kept.
namespace dripline::interpreter::fanuc {

template <class State, class Visit>
void for_each_variable(State& state, const ControlOptions& options, Visit visit) {
  if (!options.reset_clears_commons) {
    for (int number = 100; number <= options.last_common; ++number) {
      visit(CellName{"#", number, {}, Keeps::UntilPowerOff, true},
            state.commons[static_cast<std::size_t>(number - 100)]);
    }
  }
  for (int number = 500; number <= options.last_kept; ++number) {
    visit(CellName{"#", number, {}, Keeps::Always, true},
          state.kept[static_cast<std::size_t>(number - 500)]);
  }
  for (std::size_t i = 0; i < state.extra.size(); ++i) {
    visit(CellName{"#", kFirstExtra + static_cast<int>(i), {}, Keeps::Always, true},
          state.extra[i]);
  }
  visit(CellName{"#", 3002}, state.counters[kHours]);
  visit(CellName{"#", 3005}, state.counters[kSettings]);
  visit(CellName{"#", 3901}, state.counters[kMade]);
  visit(CellName{"#", 3902}, state.counters[kRequired]);
}

/// In millimeters and degrees.
template <class AnyMemory, class Visit>
void for_each_offset(AnyMemory& memory, bool is_lathe, Visit visit) {
  for (std::size_t system = 0; system < kWorkCount; ++system) {
    const int number = static_cast<int>(system);
    const std::string_view prefix = system == 0 ? "EXT" : system <= 6 ? "G" : "G54.1P";
    const int shown = system == 0 ? -1 : system <= 6 ? 53 + number : number - 6;
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      visit(CellName{prefix, shown, kAxisSuffixes[axis]}, memory.coordinates.work[system][axis]);
    }
  }
  for (int tool = 1; tool <= kMaxOffsets; ++tool) {
    const auto n = static_cast<std::size_t>(tool);
    visit(CellName{"tool.", tool, ".length"}, memory.tools.length_geometry[n]);
    visit(CellName{"tool.", tool, ".length_wear"}, memory.tools.length_wear[n]);
    visit(CellName{"tool.", tool, ".radius"}, memory.tools.radius_geometry[n]);
    visit(CellName{"tool.", tool, ".radius_wear"}, memory.tools.radius_wear[n]);
    if (!is_lathe) continue;
    visit(CellName{"tool.", tool, ".x"}, memory.tools.x_geometry[n]);
    visit(CellName{"tool.", tool, ".x_wear"}, memory.tools.x_wear[n]);
    visit(CellName{"tool.", tool, ".tip"}, memory.tools.tip[n]);
  }
}

}  // namespace dripline::interpreter::fanuc
