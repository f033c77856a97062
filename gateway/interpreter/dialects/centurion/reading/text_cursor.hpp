#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "gateway/interpreter/core/language/line_window.hpp"
#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"

namespace dripline::interpreter::centurion {

/// Longest block; a longer one is an alarm, so that a file without line ends needs no memory.
inline constexpr std::size_t kMaxBlockBytes = 4096;

/// A place between two blocks. `segment` is where the program begins that this text belongs to: a
/// file may hold several, each beginning with an O line (manual: RS-232, data format).
struct TextPosition {
  ProgramIndex program = kMainProgram;
  bool after_cr = false;   ///< the block before ended with CR: a LF here still belongs to it
  bool code_seen = false;  ///< a block with code has been passed: an O line ends the program now
  std::uint64_t segment_offset = 0;
  std::uint64_t segment_line = 1;
  std::uint64_t offset = 0;
  std::uint64_t line = 1;
  friend bool operator==(const TextPosition&, const TextPosition&) = default;
};

/// The first byte in [at, end) that ends a block, or `end`. Eight bytes at a time: this runs over
/// every byte of every program.
inline const char* find_end_of_block(const char* at, const char* end) {
  constexpr std::uint64_t kOnes = 0x0101010101010101u;
  constexpr std::uint64_t kHighs = 0x8080808080808080u;
  while (end - at >= 8) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, at, sizeof bytes);
    const std::uint64_t cr = bytes ^ (kOnes * '\r');
    const std::uint64_t lf = bytes ^ (kOnes * '\n');
    if ((((cr - kOnes) & ~cr) | ((lf - kOnes) & ~lf)) & kHighs) break;
    at += 8;
  }
  while (at != end && !is_end_of_block(*at)) ++at;
  return at;
}

/// Shows one block of text at a time, through windows of the source. Memory is one block. Any other
/// use of the source makes the window stale: call `invalidate`.
class TextCursor {
 public:
  using State = language::LineWindow::State;

  explicit TextCursor(ProgramSource& source) : window_(source, kMaxBlockBytes + 1) {}

  /// Makes the block at `position` visible; asks the source for as little as a block needs.
  State load(const TextPosition& position) {
    const bool after_cr = position.after_cr;
    const State state = window_.load(position.program, position.offset,
                                     [after_cr](const char* at, const char* limit) {
                                       if (after_cr && at != limit && *at == '\n') ++at;
                                       return find_end_of_block(at, limit);
                                     });
    if (state != State::Ready) [[unlikely]]
      return state;
    begin_ = window_.begin();
    if (after_cr && begin_ != window_.end() && *begin_ == '\n') ++begin_;
    if (!window_.is_terminated() && begin_ == end()) [[unlikely]]
      return State::EndOfText;  // nothing but the LF of a CR LF was left
    return static_cast<std::size_t>(end() - begin_) <= kMaxBlockBytes ? state : State::TooLong;
  }

  /// The block; `*end()` can be read and ends a block.
  const char* begin() const { return begin_; }
  const char* end() const { return window_.end(); }
  /// Of the block's first byte in its program.
  std::uint64_t offset() const {
    return window_.offset() + static_cast<std::uint64_t>(begin_ - window_.begin());
  }
  const std::string& failure() const { return window_.failure(); }
  void invalidate() { window_.invalidate(); }

  /// Moves `position` after the block that is visible.
  void advance(TextPosition& position) const {
    position.offset =
        offset() + static_cast<std::uint64_t>(end() - begin_) + (window_.is_terminated() ? 1 : 0);
    position.after_cr = window_.is_terminated() && *end() == '\r';
    ++position.line;
  }

 private:
  language::LineWindow window_;
  const char* begin_ = nullptr;
};

// Numbers as this control reads them: calculator format, a whole number means whole units, blanks
// may be anywhere, also between digits (manual: numbers; section 1.4).

using Number = NumberText;

/// Digits as written, leading zeros included.
inline unsigned digits_of(const Number& number) {
  return unsigned{number.leading} + number.trailing;
}

/// Reads the number at `at` and leaves `at` after it. The text must end with an end-of-block
/// character: it stops the reading, so there is no other end to look for.
inline Number read_number(const char*& at) {
  Number number;
  at = interpreter::read_number<NumberRules{.skip_blanks = true}>(at, nullptr, number);
  return number;
}

}  // namespace dripline::interpreter::centurion
