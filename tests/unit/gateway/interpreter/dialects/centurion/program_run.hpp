#pragma once

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/support/program_run.hpp"

namespace dripline::interpreter::centurion {

using ProgramRun = DialectRun<kCenturionDialect>;

}  // namespace dripline::interpreter::centurion
