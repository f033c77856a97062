#include "tests/unit/clients/tools/post/converted.hpp"

#include <fmt/format.h>
#include <stdexcept>

#include "gateway/interpreter/registry.hpp"

namespace dripline::post {

std::string Converted::reason() const {
  if (is_proved) return {};
  if (refusal) {
    return refusal->origin ? fmt::format("line {}: {}", refusal->origin->line, refusal->what)
                           : refusal->what;
  }
  if (!result) return "nothing was compared";
  if (!result->is_same) {
    const auto& place = result->places.front();
    return fmt::format("difference: line {}: {} | line {}: {} ({} mm)", place.first.line,
                       place.first_text, place.second.line, place.second_text, place.distance);
  }
  const auto& condition = result->conditions.front();
  return fmt::format("condition: {}: line {}: {}", word_of(condition.kind), condition.place.line,
                     condition.text);
}

Converted convert(const Original& original, std::string_view target_name,
                  const ConversionOptions& options) {
  const auto target = find_target(target_name);
  const auto dialect = interpreter::find_dialect(original.control);
  if (!target || !dialect) throw std::runtime_error("no such control");
  interpreter::MemorySource source(original.text, original.loader);
  const SourceProgram program{**dialect, original.setup, source, original.text};
  Converted converted;
  auto written =
      write_program(program, **target, options, [&](std::string_view text) -> Result<void> {
        converted.text += text;
        return {};
      });
  if (!written) {
    converted.refusal = written.error();
    return converted;
  }
  converted.written = *written;
  interpreter::MemorySource text(converted.text);
  auto result = prove(program, *written, text, options);
  if (!result) {
    converted.refusal = NotConverted{result.error().code, result.error().what, {}};
    return converted;
  }
  converted.result = *result;
  converted.is_proved = result->is_same && objection(*result, options) == nullptr;
  return converted;
}

interpreter::Setup setup_from(std::string_view toml) {
  auto setup = interpreter::parse_setup(toml);
  if (!setup) throw std::runtime_error(setup.error().what);
  return *setup;
}

}  // namespace dripline::post
