#pragma once

#include <vector>

#include "clients/tools/tnc_conversion/program_text.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"

namespace dripline::tnc_conversion {

using interpreter::tnc155::IsoModes;

/// What is in force in front of an ISO block, over all paths on which the run of a program can
/// reach it.
struct ModesBefore {
  IsoModes modes;
  // Where the paths disagree:
  bool is_motion_open = false;
  bool is_distance_open = false;
  bool is_turn_open = false;
  bool is_plane_open = false;         ///< whether one was programmed
  bool is_compensation_open = false;  ///< likewise
  bool is_reached = false;
  friend bool operator==(const ModesBefore&, const ModesBefore&) = default;
};

/// One for each block of the program. Labels, repeats, jumps and returns are followed; a called
/// program has modes of its own. Blocks that are never reached continue from those before them.
std::vector<ModesBefore> modes_before(const IsoProgram& program);

}  // namespace dripline::tnc_conversion
