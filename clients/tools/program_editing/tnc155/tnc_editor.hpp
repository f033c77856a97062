#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/program_editing/program_edit.hpp"

/// Editing of blocks (`program_editing.cpp`) and words (`word_editing.cpp`) as on the TNC 151/155.
/// Contracts: `ProgramEditor`.
namespace dripline::program_editing {

Result<EditedProgram> edit_program(std::string_view text, std::span<const BlockChange> changes);
Result<std::vector<BlockChange>> change_words(std::string_view text,
                                              std::span<const WordChange> changes);
Result<WordSearch> search_words(std::string_view text, std::span<const std::string> addresses);

}  // namespace dripline::program_editing
