#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// The modes that M70 and M73 of LinuxCNC save, and that M72 and the return from a subprogram
/// bring back.
namespace dripline::interpreter::rs274ngc {

void save_modes(const Run& run, SavedModes& saved);
/// Except for the motion mode. Errors: what of it compensation forbids.
bool restore_modes(Run& run, const SavedModes& saved);

}  // namespace dripline::interpreter::rs274ngc
