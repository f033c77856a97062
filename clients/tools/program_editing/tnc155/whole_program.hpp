#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/interpreter/dialects/tnc155/memory/program_memory.hpp"
#include "protocol/base/result.hpp"

/// Whole programs of the TNC 151/155: their directory entry, protection and block numbers.
namespace dripline::program_editing {

/// The directory entry of a program. Errors: Syntax (a block cannot be read; no BEGIN PGM or %
/// block; the last block names another program or other units).
Result<interpreter::tnc155::StoredProgram> describe_program(std::string_view text);

/// Sets or clears the protection in the first and the last block. Errors: as above.
Result<std::string> with_protection(std::string_view text, bool is_protected);

/// Numbers the blocks as the control does: from 0 in plain language, by the increment in ISO.
/// Errors: as above.
Result<std::string> renumbered(std::string_view text, std::int32_t increment = 10);

}  // namespace dripline::program_editing
