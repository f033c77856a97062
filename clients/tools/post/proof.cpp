#include <memory>

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

}  // namespace

Result<comparison::MotionResult> prove(const SourceProgram& source, const WrittenProgram& written,
                                       interpreter::ProgramSource& text,
                                       const ConversionOptions& options) {
  const auto dialect = interpreter::find_dialect(written.grid.target().dialect);
  if (!dialect) return fail(dialect.error());
  const comparison::MotionSide first{
      source.dialect, written.source_setup, source.source,
      [&](EventSink& out, const Position& start) -> std::unique_ptr<EventSink> {
        return std::make_unique<Adaptation>(out, written.grid, written.adaptation, start);
      }};
  // Where the target's tools are not known, they are those of the source, or what the program says.
  interpreter::Setup target_setup = written.target_setup;
  const bool defines_tools = written.grid.target().form == Form::PlainLanguage;
  if (target_setup.tools.empty() && !defines_tools) target_setup.tools = written.source_setup.tools;
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
