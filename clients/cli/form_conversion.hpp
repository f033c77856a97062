#pragma once

#include <cstdint>
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
  bool has_lf = false;  ///< LF at line ends; else CR LF as the control writes it
  std::int32_t increment = 10;
  std::string setup;  ///< file with the control's options; empty: none
};

/// True when `head`, the first bytes of a file, begins a program in the control's plain language.
bool is_plain_language(std::string_view head);

/// Gives the exit status; says on standard error why not.
int convert_form(Context& context, const FormConversion& command, client::FileSource& file);

}  // namespace dripline::cli
