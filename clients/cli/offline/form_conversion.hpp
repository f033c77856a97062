#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "clients/cli/context.hpp"
#include "clients/lib/byte_source.hpp"

namespace dripline::cli {

/// `dnc convert` between the two program forms of the HEIDENHAIN TNC 151/155.
struct FormConversion {
  std::string input, output;  ///< files; `-` writes to standard output
  bool to_plain = false;      ///< else to ISO
  bool has_decimal_point = false;
  bool has_lf = false;                    ///< LF at line ends; else CR LF as the control writes it
  std::optional<std::int32_t> increment;  ///< of ISO block numbers; absent: as in the setup
  std::string setup;                      ///< file with the control's options; empty: none
};

/// True when `head`, the first bytes of a file, begins a program in the control's plain language.
bool is_plain_language(std::string_view head);

/// Step of ISO block numbers by the options of a setup file; without a file the control's
/// own. Errors: those of reading it, and of the options.
Result<std::int32_t> block_increment_of(const std::string& setup_file);

/// Returns the exit status; prints the reason of a failure on standard error.
int convert_form(Context& context, const FormConversion& command, client::FileSource& file);

}  // namespace dripline::cli
