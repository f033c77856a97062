#pragma once

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// What a line means, before anything of it is executed: which motion its axis words belong to
/// (4.2), and whether every word has a user (2.3).
namespace dripline::interpreter::rs274ngc {

bool check_line(Run& run);

}  // namespace dripline::interpreter::rs274ngc
