#include "clients/tools/tnc_conversion/conversion.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

Result<Form> form_of(std::string_view text) {
  const Form form = detect_form(text);
  if (form == Form::Unknown) {
    return fail(Errc::Syntax, "line 1: neither plain language nor ISO of a TNC");
  }
  return form;
}

Result<std::string> rewrite_iso(std::string_view text, const ConversionOptions& options) {
  const auto program = read_iso_program(text, options.reading);
  if (!program) return fail(program.error());
  std::string written;
  for (const auto& [block, line] : program->blocks) {
    write_iso_block(block, options.layout, written);
  }
  return written;
}

Result<std::string> rewrite_plain(std::string_view text, const ConversionOptions& options) {
  const auto program = read_plain_program(text, options.reading);
  if (!program) return fail(program.error());
  std::string written;
  for (const Block& block : program->blocks) {
    write_plain_block(block, program->units, options.layout, written);
  }
  return written;
}

}  // namespace

ConversionOptions conversion_options(const ControlOptions& control) {
  ConversionOptions options;
  options.layout.decimal_sign = control.decimal_sign;
  options.reading = {control.iso_continuation, control.version};
  options.increment = control.block_increment;
  return options;
}

Result<std::string> rewrite_program(std::string_view text, const ConversionOptions& options) {
  const auto form = form_of(text);
  if (!form) return fail(form.error());
  return *form == Form::Iso ? rewrite_iso(text, options) : rewrite_plain(text, options);
}

Result<std::string> convert_program(std::string_view text, Form form,
                                    const ConversionOptions& options) {
  const auto from = form_of(text);
  if (!from) return fail(from.error());
  if (*from == form) return rewrite_program(text, options);
  if (form == Form::Iso) {
    const auto program = read_plain_program(text, options.reading);
    return program ? to_iso(*program, options) : fail(program.error());
  }
  const auto program = read_iso_program(text, options.reading);
  return program ? to_plain(*program, options) : fail(program.error());
}

}  // namespace dripline::tnc_conversion
