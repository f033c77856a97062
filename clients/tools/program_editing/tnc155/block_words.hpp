#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"
#include "protocol/base/result.hpp"

/// The words of a block for editing word by word: addresses and the places of their values in a
/// text as the control writes it (text_layout.hpp). The readers check the values.
namespace dripline::program_editing {

using interpreter::tnc155::Form;

struct BlockWord {
  /// Plain language: "X", "IX", "F", "TOOL CALL", "="; ISO: "X", "G41", "P01".
  std::string_view address;
  std::string_view value;  ///< empty: none, as of "R" in "L X+5,000 R F M"; may follow a blank
  std::size_t begin = 0, end = 0;  ///< of both, in the block's text
};

/// `text`: one block without its plain-language number. The words refer to it.
std::vector<BlockWord> words_of(std::string_view text, Form form);

/// What an operator typed, capitals or not, with blanks or without.
struct TypedWord {
  std::string address;  ///< as a BlockWord has it
  std::string value;
};

/// "X+5", "F MAX", "tool call 2". Errors: Syntax (no address of the form, more than one word).
Result<TypedWord> read_typed_word(std::string_view typed, Form form);

/// An address without a value; in ISO also G and P, for all of theirs. Errors: Syntax.
Result<std::string> read_typed_address(std::string_view typed, Form form);

/// Whether a search for `address` shows a block with this word: not for the R, F and M of what is
/// not programmed. Q is found in values as well.
bool is_found_by(const BlockWord& word, std::string_view address);

/// The word that a new value is for: that of the address; of several the one that has a value as
/// the typed one has; in ISO a G function of the same group; in plain language the spindle axis for
/// an axis alone. nullptr: the block has none.
const BlockWord* word_for(const std::vector<BlockWord>& words, const TypedWord& typed, Form form);

}  // namespace dripline::program_editing
