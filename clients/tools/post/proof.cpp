#include <algorithm>
#include <memory>
#include <vector>

#include "clients/tools/post/adapted_source.hpp"
#include "clients/tools/post/compensation_reader.hpp"
#include "clients/tools/post/conversion.hpp"

namespace dripline::post {
namespace {

using comparison::Condition;
using interpreter::EventSink;
using interpreter::Position;

bool is_of_setup(Condition::Kind kind) {
  using enum Condition::Kind;
  return kind == Prompt || kind == Input || kind == Clock || kind == Variable ||
         kind == BlockSkip || kind == Start;
}

/// The tools that the program runs with. Those that a table lacks are there without length or
/// radius, which are what the program was written with.
std::vector<interpreter::ToolRecord> tools_of(const WrittenProgram& written) {
  const Target& target = written.grid.target();
  auto tools = tools_at(target, written.target_setup, written.source_setup);
  if (!target.has_tool_table) return tools;
  for (const int number : written.tools) {
    const bool is_known =
        std::ranges::find(tools, number, &interpreter::ToolRecord::number) != tools.end();
    if (!is_known && number != 0) tools.emplace_back().number = number;
  }
  return tools;
}

/// The radii of the source at the numbers that the written program names.
void set_radii(const KeptCompensation& compensation, double factor,
               std::vector<interpreter::ToolRecord>& tools) {
  for (const auto& [number, radius] : compensation.radii) {
    auto tool = std::ranges::find(tools, number, &interpreter::ToolRecord::number);
    if (tool == tools.end()) {
      tools.emplace_back().number = number;
      tool = std::prev(tools.end());
    }
    tool->radius = Length::mm(radius * factor);
    tool->radius_wear = {};
  }
}

/// All of the main program; empty where there is none.
std::string text_of(interpreter::ProgramSource& source) {
  std::string text;
  for (;;) {
    const auto window = source.fetch(interpreter::kMainProgram, text.size(),
                                     interpreter::ProgramSource::kMaxWindow);
    if (window.state != interpreter::TextWindow::State::Ready) return {};
    text += window.text;
    if (window.reaches_end) return text;
  }
}

/// With the radii of tools that texts define times `factor`, where it is not 1.
struct ScaledText {
  std::unique_ptr<ReplacedSource> replaced;
  interpreter::ProgramSource& source;

  ScaledText(interpreter::ProgramSource& original, bool defines_radii, double factor)
      : replaced(defines_radii && factor != 1
                     ? std::make_unique<ReplacedSource>(
                           original, scaled_definitions(text_of(original), factor))
                     : nullptr),
        source(replaced ? static_cast<interpreter::ProgramSource&>(*replaced) : original) {}
};

Result<comparison::MotionResult> compare(const SourceProgram& source, const WrittenProgram& written,
                                         interpreter::ProgramSource& text,
                                         const ConversionOptions& options, double factor) {
  const Target& target = written.grid.target();
  const auto dialect = interpreter::find_dialect(target.dialect);
  if (!dialect) return fail(dialect.error());
  const bool is_kept = written.compensation.is_used();
  AdaptationOptions adaptation = written.adaptation;
  adaptation.is_off_grid = is_kept;
  const interpreter::Setup source_setup = scaled_radii(written.source_setup, factor);
  const ScaledText source_text(source.source, defines_radii(source.dialect), factor);
  const comparison::MotionSide first{
      source.dialect, source_setup, source_text.source,
      [&](EventSink& out, const Position& start) -> std::unique_ptr<EventSink> {
        return std::make_unique<AdaptedSource>(out, written.grid, adaptation, start);
      }};
  interpreter::Setup target_setup = scaled_radii(written.target_setup, factor);
  target_setup.tools = tools_of(written);
  set_radii(written.compensation, factor, target_setup.tools);
  const ScaledText target_text(text, defines_radii(**dialect), factor);
  const comparison::MotionSide second{
      **dialect, target_setup, target_text.source,
      [&](EventSink& out, const Position& start) -> std::unique_ptr<EventSink> {
        return std::make_unique<TargetView>(out, target, start);
      }};
  comparison::MotionOptions how;
  how.tolerance = written.tolerance;
  how.max_places = 20;
  how.across_controls = true;
  how.started_axes = axes_of(target);
  auto comparison = comparison::MotionComparison::begin(first, second, how);
  if (!comparison) return fail(comparison.error());
  while (!comparison->step()) {
    if (options.is_to_stop && options.is_to_stop()) return fail(Errc::Timeout, "interrupted");
  }
  return comparison->result();
}

}  // namespace

Result<comparison::MotionResult> prove(const SourceProgram& source, const WrittenProgram& written,
                                       interpreter::ProgramSource& text,
                                       const ConversionOptions& options) {
  auto result = compare(source, written, text, options, 1);
  if (!written.compensation.is_used() || !result) return result;
  if (!result->is_same || objection(*result, options) != nullptr) return result;
  return compare(source, written, text, options, kOtherRadius);
}

const comparison::Condition* objection(const comparison::MotionResult& result,
                                       const ConversionOptions& options) {
  for (const Condition& condition : result.conditions) {
    if (!options.is_as_set_up || !is_of_setup(condition.kind)) return &condition;
  }
  return nullptr;
}

}  // namespace dripline::post
