#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/diagnostic.hpp"
#include "gateway/interpreter/core/program_edit.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/core/word_edit.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter {

/// Whether a control could keep a program, with all those it calls, in its own memory.
struct MemoryVerdict {
  /// The setup says that the control keeps its programs: what it refuses cannot run. Otherwise
  /// they are drip-fed, and a refusal is only worth a warning.
  bool is_binding = false;
  /// In the order the programs would be loaded. Lines are those of the program that was started; of
  /// a called one, the line of its call.
  std::vector<Diagnostic> refused;
};

/// What a control with numbered blocks and a program memory of its own makes of a program's text.
/// Pure functions; any thread.
struct ProgramStorage {
  /// Reads at most a bounded part of each program. `source` must hold all of its text. Errors:
  /// those of the control's options.
  Result<MemoryVerdict> (*fit)(const Setup& setup, ProgramSource& source);
  /// Whether the program says that it must be neither erased nor changed. `head`: its first bytes.
  bool (*is_protected)(std::string_view head);
  /// Sets or takes away that mark. Errors: Syntax.
  Result<std::string> (*protect)(std::string_view text, bool is_protected);
  /// Blocks that stay keep their text, but for their numbers; those put in are read as the control
  /// reads them and written as it writes them. Errors: those of plan_edit; Syntax (a block the
  /// control refuses, in its words), LimitExceeded (no number left).
  Result<EditedProgram> (*edit)(std::string_view text, std::span<const BlockChange> changes);
  /// What blocks become whose words are changed, as Replace for `edit`. Sets come first. Errors:
  /// those of find_block; NotFound (the block has no such word), Conflict (a word changed
  /// twice), Syntax (no word of the control, or the block it would make is refused).
  Result<std::vector<BlockChange>> (*change_words)(std::string_view text,
                                                   std::span<const WordChange> changes);
  /// The blocks that have a word with one of the addresses. Errors: Syntax.
  Result<WordSearch> (*search)(std::string_view text, std::span<const std::string> addresses);
  /// Numbers all blocks as the control does; `increment` where it lets choose. Errors: Syntax.
  Result<std::string> (*renumber)(std::string_view text, std::int32_t increment);
};

}  // namespace dripline::interpreter
