#pragma once

#include <string>

#include "gateway/interpreter/dialects/tnc155/conversion/conversion.hpp"
#include "gateway/interpreter/dialects/tnc155/editing/program_text.hpp"

/// The two directions of the conversion; errors as of `convert_program`.
namespace dripline::interpreter::tnc155 {

Result<std::string> to_iso(const PlainProgram& program, const ConversionOptions& options);
Result<std::string> to_plain(const IsoProgram& program, const ConversionOptions& options);

}  // namespace dripline::interpreter::tnc155
