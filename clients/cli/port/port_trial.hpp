#pragma once

#include <string>

#include "clients/cli/context.hpp"

/// Trying a port without a program. Each gives the exit status.
namespace dripline::cli {

int test_port(Context& context, const std::string& name);
/// Shows what the port's rules would do with the text in `file`.
int test_rules(Context& context, const std::string& name, const std::string& file);

}  // namespace dripline::cli
