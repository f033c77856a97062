#include "gateway/interpreter/tnc155/program_text.hpp"

#include "gateway/interpreter/memory_source.hpp"
#include "gateway/interpreter/tnc155/block_end.hpp"
#include "gateway/interpreter/tnc155/plain_reader.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

Error fault_of(const BlockReader& reader) {
  return {Errc::Syntax, fmt::format("line {}, column {}: {}", reader.fault_line(),
                                    reader.fault().column, reader.fault().text())};
}

/// Calls `take` with every block read; false from it ends the program.
template <class Take>
Result<void> walk(std::string_view text, Form form, ReaderOptions options, Take take) {
  MemorySource source(text);
  BlockReader reader(source, options);
  ReadingState state;
  state.program.form = form;
  BlockParts parts;
  bool is_over = false;
  while (true) {
    switch (reader.next(state, parts)) {
      case ReadState::Ready:
        if (is_over) {
          return fail(Errc::Unsupported, "line {}: text behind the last block of the program",
                      reader.block_place().line);
        }
        is_over = !take(reader, state, parts);
        break;
      case ReadState::End:
        return {};
      case ReadState::Wrong:
        if (is_over) {
          return fail(Errc::Unsupported, "line {}: text behind the last block of the program",
                      reader.block_place().line);
        }
        return fail(fault_of(reader));
      default:
        return fail(Errc::Io, "{}", reader.reason());
    }
  }
}

}  // namespace

Result<PlainProgram> read_plain_program(std::string_view text) {
  PlainProgram program;
  auto walked = walk(text, Form::Plain, {},
                     [&](const BlockReader& reader, const ReadingState& state,
                         const BlockParts& parts) {
                       program.units = state.program.units;
                       program.blocks.push_back({parts.blocks[0], reader.block_place().line});
                       return parts.blocks[0].kind != BlockKind::End;
                     });
  if (!walked) return fail(walked.error());
  return program;
}

namespace {

/// In the order of the text nothing is known of what is in force: a block is only taken apart.
bool read_words(BlockReader& reader, ReadingState& state, IsoBlock& block);

}  // namespace

}  // namespace dripline::interpreter::tnc155
