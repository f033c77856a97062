#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::tnc155 {

/// Does one block (one part of an ISO block). False: see Run::pause.
bool execute(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155
