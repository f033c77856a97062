#pragma once

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/support/program_run.hpp"

namespace dripline::interpreter::fanuc {

using ProgramRun = DialectRun<kFanucDialect>;

}  // namespace dripline::interpreter::fanuc
