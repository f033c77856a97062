#pragma once

#include <bit>
#include <cstdint>
#include <string>

/// No block with axis words vanishes: it moves, changes a state that stays, or reports why not.
namespace dripline::interpreter::language {

/// The words of the block in hand that have to lead to something. Every dialect opens it with the
/// words it has read, takes each where it is used, and reports what is left at the end of the
/// block: an axis word with an alarm, because the tool is then not where the program
/// has it; any other with a warning.
///
/// A word is used by an event, by a state that stays (an offset, a datum, a cycle's level) or by a
/// message that names it. A move to where the tool is already uses its words. A plain move, which
/// by its form leaves nothing, does not need the account. No allocation; one bit per word.
class WordLedger {
 public:
  /// One bit each, numbered as the dialect numbers its addresses.
  using Words = std::uint64_t;

  void open(Words owed) { left_ = owed; }
  void take(Words words) { left_ &= ~words; }
  void take_all() { left_ = 0; }
  Words left() const { return left_; }

 private:
  Words left_ = 0;
};

/// "X12.5 R2", for the report: `text_of(i)` is the word of bit `i`.
template <class TextOf>
std::string listed(WordLedger::Words words, TextOf text_of) {
  std::string text;
  for (; words != 0; words &= words - 1) {
    if (!text.empty()) text += ' ';
    text += text_of(static_cast<std::size_t>(std::countr_zero(words)));
  }
  return text;
}

}  // namespace dripline::interpreter::language
