#pragma once

#include <string>

#include "protocol/base/result.hpp"

namespace dripline::cli {

/// Asks on the terminal, without showing what is typed; from anything else than a terminal it takes
/// one line of standard input. Errors: Io, Syntax (nothing was given).
Result<std::string> ask_password(const std::string& prompt);
/// The same twice, on a terminal, so that a slip of the finger does not lock a user out.
Result<std::string> ask_new_password(const std::string& prompt);

}  // namespace dripline::cli
