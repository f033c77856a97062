#pragma once

#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

inline constexpr std::size_t kMaxProgramName = 128;
inline constexpr std::size_t kMaxMachineName = 64;

/// Names are checked where they enter; after that they are plain strings.
/// A program name: 1 to 128 characters, letters, digits and ` ._-+`, not beginning with a dot, a
/// minus or a blank and not ending with a blank, so that it can neither leave a folder nor hide in
/// one, nor be read as an option.
/// Errors: Syntax, LimitExceeded.
Result<void> check_program_name(std::string_view name);

/// A machine name: 1 to 64 characters, lower-case letters, digits, `-` and `_`, beginning with a
/// letter or digit. It is used as a DDS partition and in file names. Errors: Syntax, LimitExceeded.
Result<void> check_machine_name(std::string_view name);

/// The name of a serial port: the same rule.
Result<void> check_port_name(std::string_view name);

}  // namespace dripline
