#pragma once

#include <string>

#include "clients/tools/tnc_conversion/conversion.hpp"
#include "clients/tools/tnc_conversion/program_text.hpp"

/// The two directions of the conversion; errors as of `convert_program`.
namespace dripline::tnc_conversion {

Result<std::string> to_iso(const PlainProgram& program, const ConversionOptions& options);
Result<std::string> to_plain(const IsoProgram& program, const ConversionOptions& options);

}  // namespace dripline::tnc_conversion
