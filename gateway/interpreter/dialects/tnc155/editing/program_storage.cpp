#include "gateway/interpreter/dialects/tnc155/editing/program_storage.hpp"

#include "gateway/interpreter/core/memory_source.hpp"
#include "gateway/interpreter/dialects/tnc155/editing/program_memory.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

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

const ProgramStorage kTncProgramStorage{.fit = &check_memory,
                                        .is_protected = &is_protected,
                                        .protect = &with_protection,
                                        .edit = &edit_program,
                                        .change_words = &change_words,
                                        .search = &search_words,
                                        .renumber = &renumbered};

}  // namespace dripline::interpreter::tnc155
