#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// G990 and G991: `Pp Ln Qq G990` keeps n user parameters from Pp on in file Qq, G991 brings them
/// back (spec 15.6). Left out: p 0, n 10, q 0.
namespace dripline::interpreter::centurion {

bool save_parameters(Run& run, const GRow&);
bool load_parameters(Run& run, const GRow&);

}  // namespace dripline::interpreter::centurion
