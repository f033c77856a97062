#include <algorithm>
#include <memory>
#include <vector>

#include "clients/tools/post/adapted_source.hpp"
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

}  // namespace

Result<comparison::MotionResult> prove(const SourceProgram& source, const WrittenProgram& written,
                                       interpreter::ProgramSource& text,
                                       const ConversionOptions& options) {
  const auto dialect = interpreter::find_dialect(written.grid.target().dialect);
  if (!dialect) return fail(dialect.error());
  const comparison::MotionSide first{
      source.dialect, written.source_setup, source.source,
      [&](EventSink& out, const Position& start) -> std::unique_ptr<EventSink> {
        return std::make_unique<AdaptedSource>(out, written.grid, written.adaptation, start);
      }};
  interpreter::Setup target_setup = written.target_setup;
  target_setup.tools = tools_of(written);
  const comparison::MotionSide second{
      **dialect, target_setup, text,
      [&](EventSink& out, const Position& start) -> std::unique_ptr<EventSink> {
        return std::make_unique<TargetView>(out, written.grid.target(), start);
      }};
  comparison::MotionOptions how;
  how.tolerance = written.tolerance;
  how.max_places = 20;
  how.across_controls = true;
  how.started_axes = axes_of(written.grid.target());
  auto comparison = comparison::MotionComparison::begin(first, second, how);
  if (!comparison) return fail(comparison.error());
  while (!comparison->step()) {
    if (options.is_to_stop && options.is_to_stop()) return fail(Errc::Timeout, "interrupted");
  }
  return comparison->result();
}

const comparison::Condition* objection(const comparison::MotionResult& result,
                                       const ConversionOptions& options) {
  for (const Condition& condition : result.conditions) {
    if (!options.is_as_set_up || !is_of_setup(condition.kind)) return &condition;
  }
  return nullptr;
}

}  // namespace dripline::post
