#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/program_editing/program_edit.hpp"
#include "protocol/base/result.hpp"

namespace dripline::program_editing {

/// The editor of a control that keeps its programs in numbered blocks. Pure functions; any thread.
struct ProgramEditor {
  std::string_view control;  ///< name of its dialect
  /// Sets or clears the mark that protects a program from being erased or changed. Errors: Syntax.
  Result<std::string> (*protect)(std::string_view text, bool is_protected);
  /// Blocks that stay keep their text except for their numbers; inserted blocks are read as the
  /// control reads them and written as it writes them. Errors: those of plan_edit; Syntax (a block
  /// the control refuses, with its message), LimitExceeded (no block number is left).
  Result<EditedProgram> (*edit)(std::string_view text, std::span<const BlockChange> changes);
  /// Turns changes of words into replaced blocks for `edit`. Sets are applied first. Errors: those
  /// of find_block; NotFound (the block has no such word), Conflict (a word is changed twice),
  /// Syntax (not a word of the control, or the resulting block is refused).
  Result<std::vector<BlockChange>> (*change_words)(std::string_view text,
                                                   std::span<const WordChange> changes);
  /// Finds the blocks that have a word with one of the addresses. Errors: Syntax.
  Result<WordSearch> (*search)(std::string_view text, std::span<const std::string> addresses);
  /// Numbers all blocks as the control does; `increment` applies where the control allows a choice.
  /// Errors: Syntax.
  Result<std::string> (*renumber)(std::string_view text, std::int32_t increment);
};

/// nullptr: the control keeps a program as its lines, see `edit_lines`.
const ProgramEditor* find_program_editor(std::string_view control);

}  // namespace dripline::program_editing
