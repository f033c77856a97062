#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `dnc run attestation` and `dnc run verify`.
void add_attestation_commands(Command group, Context& context);

}  // namespace dripline::cli
