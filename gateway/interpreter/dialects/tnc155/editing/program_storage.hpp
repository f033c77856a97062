#pragma once

#include "gateway/interpreter/core/program_storage.hpp"

namespace dripline::interpreter::tnc155 {

/// The program memory of the TNC 151/155: 32 programs, 3100 blocks, protection, editing.
extern const ProgramStorage kTncProgramStorage;

/// As ProgramStorage says. In `memory_check.cpp`, `program_editing.cpp` and `word_editing.cpp`.
Result<MemoryVerdict> check_memory(const Setup& setup, ProgramSource& source);
Result<EditedProgram> edit_program(std::string_view text, std::span<const BlockChange> changes);
Result<std::vector<BlockChange>> change_words(std::string_view text,
                                              std::span<const WordChange> changes);
Result<WordSearch> search_words(std::string_view text, std::span<const std::string> addresses);

}  // namespace dripline::interpreter::tnc155
