#include "gateway/interpreter/tnc155/program_keeping.hpp"

#include "gateway/interpreter/memory_source.hpp"
#include "gateway/interpreter/tnc155/block_reader.hpp"
#include "gateway/interpreter/tnc155/program_memory.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool is_protected(std::string_view head) {
  MemorySource source(head);
  BlockReader reader(source);
  ReadingState state;
  BlockParts parts;
  if (reader.next(state, parts) != ReadState::Ready || parts.count == 0) return false;
  return parts.blocks[0].kind == BlockKind::Begin && parts.blocks[0].is_protected;
}

}  // namespace

const ProgramKeeping kTncKeeping{&check_memory, &is_protected, &with_protection, &edit_program,
                                 &renumbered};

}  // namespace dripline::interpreter::tnc155
