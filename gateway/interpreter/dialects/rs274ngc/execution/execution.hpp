#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// A line that has been read and checked is done in the control's order (5).
namespace dripline::interpreter::rs274ngc {

/// Goes on from `Block::stage`: an answer resumes where its question was asked.
bool execute_line(Run& run);

void apply_settings(Run& run);

}  // namespace dripline::interpreter::rs274ngc
