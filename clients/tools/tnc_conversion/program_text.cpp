#include "clients/tools/tnc_conversion/program_text.hpp"

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

/// Reads with `next` up to the block for which `take` gives false, and sees that nothing follows.
template <class Next, class Take>
Result<void> walk(BlockReader& reader, Next next, Take take) {
  bool is_over = false;
  while (true) {
    const ReadState read = next();
    if (read == ReadState::End) return {};
    if (is_over && (read == ReadState::Ready || read == ReadState::Wrong)) {
      return fail(Errc::Unsupported, "text after the last block of the program");
    }
    if (read == ReadState::Wrong) {
      return fail(Errc::Syntax, "line {}, column {}: {}", reader.fault_line(),
                  reader.fault().column, reader.fault().text());
    }
    if (read != ReadState::Ready) return fail(Errc::Io, "{}", reader.reason());
    is_over = !take();
  }
}

/// The last block of an ISO program names it again.
bool is_last(const IsoBlock& block, const ProgramForm& program, bool is_first) {
  if (block.program == IsoBlock::kNone || is_first) return false;
  return block.has(IsoGroup::Unit) || block.program == program.number;
}

}  // namespace

Result<PlainProgram> read_plain_program(std::string_view text, const ReaderOptions& options) {
  MemorySource source(text);
  BlockReader reader(source, options);
  PlainProgram program;
  ReadingState state;
  state.program.form = Form::Plain;
  BlockParts parts;
  const auto walked = walk(
      reader, [&] { return reader.next(state, parts); },
      [&] {
        program.blocks.push_back(parts.blocks[0]);
        program.lines.push_back(reader.block_place().line);
        return parts.blocks[0].kind != BlockKind::End;
      });
  if (!walked) return fail(walked.error());
  program.units = state.program.units;
  return program;
}

Result<IsoProgram> read_iso_program(std::string_view text, const ReaderOptions& options) {
  MemorySource source(text);
  BlockReader reader(source, options);
  IsoProgram program;
  ReadingState state;
  state.program.form = Form::Iso;
  const auto walked = walk(
      reader, [&] { return reader.next_words(state); },
      [&] {
        const bool is_first = program.blocks.empty();
        program.blocks.push_back({reader.iso_block(), reader.block_place().line});
        return !is_last(reader.iso_block(), state.program, is_first);
      });
  if (!walked) return fail(walked.error());
  program.units = state.program.units;
  return program;
}

}  // namespace dripline::tnc_conversion
