#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/tools/program_editing/program_edit.hpp"

/// Find and change of a control that keeps a program as its lines (Centurion manual: text editor,
/// FIND and CHNG). Pure; any thread.

namespace dripline::program_editing {

/// The longest text that the control's editor finds.
inline constexpr std::size_t kMaxFindText = 67;

struct TextPattern {
  std::string text;            ///< within one line
  bool ignores_case = false;   ///< the editor's option U; of A to Z
  bool is_whole_word = false;  ///< W: no letter, digit or underscore on either side,
                               ///< and no part of a number
  std::optional<std::pair<std::int64_t, std::int64_t>> lines =
      {};  ///< L: the marked block, inclusive
};

/// Finds the lines that contain the text; `block` is their number, from 1. Errors: Syntax (an empty
/// text, one of several lines, a range that runs backwards), LimitExceeded (a text over
/// kMaxFindText), NotFound (a range past the last line).
Result<std::vector<WordSearch::Found>> find_text(std::string_view text, const TextPattern& pattern);

/// Turns every occurrence into `replacement`, left to right without overlap, as replaced lines for
/// `edit_lines`. Errors: those of find_text; NotFound (the text does not occur), Conflict (a line
/// would be blank: it is to be deleted instead).
Result<std::vector<BlockChange>> change_text(std::string_view text, const TextPattern& pattern,
                                             std::string_view replacement);

}  // namespace dripline::program_editing
