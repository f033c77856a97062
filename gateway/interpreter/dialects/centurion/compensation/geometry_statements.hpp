#pragma once

#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

/// TANL, TANA and CGEN (manual): from the parameters P90-P97 to P80-P85 and P97.
namespace dripline::interpreter::centurion {

/// The rest of the statement whose word begins at `start`; `at` is after the word and moves on.
bool solve_geometry(Run& run, Keyword keyword, const char* start, const char*& at);

}  // namespace dripline::interpreter::centurion
