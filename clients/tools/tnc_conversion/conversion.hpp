#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/tnc_conversion/program_text.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "protocol/base/result.hpp"

/// Whole programs from text to text. Pure; memory is a small multiple of the text.

namespace dripline::tnc_conversion {

using interpreter::tnc155::ControlOptions;
using interpreter::tnc155::Form;
using interpreter::tnc155::ReaderOptions;

struct ConversionOptions {
  TextLayout layout;
  std::int32_t increment = 10;  ///< of ISO block numbers; 0: blocks without numbers
  ReaderOptions reading = {};   ///< what of the text the control takes
};

/// From the options of a control: the decimal sign, the lines that continue a block, and the
/// version, which may not take all blocks.
ConversionOptions conversion_options(const ControlOptions& control);

/// The program in the control's own layout, in the form it is in. Errors: Syntax, with line, column
/// and the control's words.
Result<std::string> rewrite_program(std::string_view text, const ConversionOptions& options = {});

/// The program in the other form, or in its own when it is in `form` already. It does the same in
/// both: whatever has no counterpart is refused. Errors: Syntax (as above), Unsupported (the line,
/// and what has no counterpart).
Result<std::string> convert_program(std::string_view text, Form form,
                                    const ConversionOptions& options = {});

// The two directions of the conversion; errors as of `convert_program`.

Result<std::string> to_iso(const PlainProgram& program, const ConversionOptions& options);
Result<std::string> to_plain(const IsoProgram& program, const ConversionOptions& options);

}  // namespace dripline::tnc_conversion
