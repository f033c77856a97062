#pragma once

#include "clients/cli/context.hpp"

namespace dripline::cli {

/// `machine parameters` and `machine pins`.
void add_value_verbs(Command group, Context& context);

}  // namespace dripline::cli
