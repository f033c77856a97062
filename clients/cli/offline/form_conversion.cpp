#include "clients/cli/offline/form_conversion.hpp"

#include "clients/cli/exit_status.hpp"
#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/tnc_conversion/conversion.hpp"

namespace dripline::cli {
namespace {

namespace tnc155 = interpreter::tnc155;

/// The control's options for written programs.
Result<tnc_conversion::ConversionOptions> options_of(const std::string& file) {
  if (file.empty()) return tnc_conversion::ConversionOptions{};
  const auto mapped = MappedFile::open(file);
  if (!mapped) return fail(mapped.error());
  const auto setup = interpreter::parse_setup(mapped->text());
  if (!setup) return fail(setup.error().code, "setup file {}: {}", file, setup.error().what);
  const auto control = tnc155::read_options(*setup);
  if (!control) return fail(control.error().code, "{}: {}", file, control.error().what);
  return tnc_conversion::conversion_options(*control);
}

Result<std::string> converted(const FormConversion& command, client::FileSource& file) {
  std::string text(file.size(), '\0');
  if (auto read = file.read(0, text); !read) return fail(std::move(read.error()));
  auto known = options_of(command.setup);
  if (!known) return fail(known.error());
  tnc_conversion::ConversionOptions options = *known;
  if (command.has_decimal_point) options.layout.decimal_sign = '.';
  if (command.has_lf) options.layout.line_end = "\n";
  options.increment = command.increment.value_or(options.increment);
  const auto form = command.to_plain ? tnc155::Form::Plain : tnc155::Form::Iso;
  auto program = tnc_conversion::convert_program(text, form, options);
  if (!program) return fail(program.error().code, "{}: {}", command.input, program.error().what);
  return program;
}

}  // namespace

bool is_plain_language(std::string_view head) {
  const auto line = head.substr(0, head.find('\n'));
  return tnc155::detect_form(head) == tnc155::Form::Plain &&
         line.find("BEGIN PGM") != std::string_view::npos;
}

Result<std::int32_t> block_increment_of(const std::string& setup_file) {
  const auto options = options_of(setup_file);
  if (!options) return fail(options.error());
  return options->increment;
}

int convert_form(Context& context, const FormConversion& command, client::FileSource& file) {
  const auto program = converted(command, file);
  if (!program) {
    complain(program.error());
    return program.error().code == Errc::Io ? kExitUsage : kExitNo;
  }
  const int status = write_to(command.output, *program);
  if (status != kExitOk || command.output == "-") return status;
  context.print(fmt::format("Converted {} -> {} ({})\n", command.input, command.output,
                            command.to_plain ? "plain language" : "ISO"));
  return kExitOk;
}

}  // namespace dripline::cli
