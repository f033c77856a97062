#include "gateway/interpreter/dialects/tnc155/reading/program_calls.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/tnc155/options.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

Result<ProgramCalls> calls_of(const Result<ControlOptions>& options, ProgramSource& source,
                              ProgramIndex program) {
  if (!options) return fail(options.error());
  BlockReader reader(source, {options->iso_continuation, options->version, options->is_itnc});
  TextPlace start;
  start.program = program;
  reader.seek(start);
  ReadingState state;
  BlockParts parts;
  CallCollector calls;
  for (;;) {
    const ReadState read = reader.next(state, parts);
    if (read == ReadState::End) return calls.take();
    if (read == ReadState::Failed) return fail(Errc::Io, "{}", reader.reason());
    if (read == ReadState::NotYet)
      return fail(Errc::Unsupported, "the text after line {} is not here", reader.place().line);
    // The run alarms at what is no block; what the text calls after it is still known.
    const std::uint64_t line = reader.place().line;
    if (read == ReadState::Wrong) {
      if (state.program.form == Form::Unknown || !reader.skip_wrong())
        return fail(Errc::Syntax, "line {} is no block of this control", line);
      continue;
    }
    for (const Block& block : parts) {
      const bool is_call =
          block.kind == BlockKind::ProgramCall || block.kind == BlockKind::Print ||
          (block.kind == BlockKind::CycleDefinition && block.cycle == kProgramCall);
      const bool has_name = is_call && !parts.itnc.name.empty();
      if (!is_call || (block.target == Block::kNone && !has_name)) continue;
      calls.add({.name = has_name ? parts.itnc.name : fmt::format("{}", block.target),
                 .earlier = {},
                 .line = reader.block_place().line});
    }
    if (parts.count != 0 && parts.blocks[parts.count - 1].kind == BlockKind::End)
      return calls.take();
  }
}

}  // namespace

Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source,
                                   ProgramIndex program) {
  return calls_of(read_options(setup), source, program);
}

Result<ProgramCalls> itnc_program_calls(const Setup& setup, ProgramSource& source,
                                        ProgramIndex program) {
  return calls_of(read_itnc_options(setup), source, program);
}

}  // namespace dripline::interpreter::tnc155
