#pragma once

#include <vector>

#include "protocol/wire/character_coder.hpp"

namespace dripline::wire {

/// A program as the characters of a plain transfer:
///   leader, start character, text, end character, trailer.
/// A printable start character is a block of its own; text that begins with it is sent unchanged.
/// Text may contain its end character: only blank text may follow, and is dropped.
class ProgramWriter {
 public:
  explicit ProgramWriter(const LineSettings& settings);

  void begin();
  /// Checks the next piece of text before it is queued. Errors: Syntax, with the line.
  Result<void> check(std::string_view text);

  /// The next character of the checked text; only while wants_text().
  void put_text(char character);
  bool wants_text() const { return stage_ == Stage::Text && !has_next(); }
  void end_text();

  bool has_next() const { return blanks_ > 0 || next_ < pending_.size(); }
  std::byte next();
  bool ends_block() const { return ends_block_; }  ///< of the character that next() returned last
  /// The text's own end character was returned: the rest of the text is dropped.
  bool is_end_said() const { return place_.is_ended && next_ == pending_.size(); }
  /// No character that is significant for the other end is left.
  bool is_all_said() const { return stage_ == Stage::End && next_ == pending_.size(); }
  bool is_done() const { return stage_ == Stage::End && !has_next(); }

 private:
  enum class Stage : std::uint8_t { Text, End };
  void put_mark(char mark);
  void put_end_of_block();

  const LineSettings& settings_;
  CharacterEncoder checked_, encoder_;
  struct Place {  ///< position in the text: of check(), and of put_text()
    bool is_first = true, is_ended = false;
    std::size_t line = 1;
    bool ends(char character, const LineSettings& settings);
  };
  Place checked_place_, place_;
  Stage stage_ = Stage::End;
  unsigned blanks_ = 0;  ///< of the leader or, at the end, of the trailer
  std::vector<std::byte> pending_;
  std::size_t next_ = 0;
  char last_ = '\n';
  bool pending_ends_block_ = false, ends_block_ = false;
};

}  // namespace dripline::wire
