#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "gateway/interpreter/fanuc/characters.hpp"
#include "gateway/interpreter/program_source.hpp"

namespace dripline::interpreter::fanuc {

/// Longest line; a longer one is an alarm, so that a file without line ends needs no memory.
inline constexpr std::size_t kMaxLineBytes = 1024;

/// A place between two blocks. `segment` is where the program begins that this text belongs to: a
/// record may hold several, each beginning with an O word.
struct TextPosition {
  ProgramIndex program = kMainProgram;
  bool head_seen = false;  ///< a % ended the leader, or a block came: the next % ends the record
  bool code_seen = false;  ///< a block with code has been passed: an O word now ends the program
  std::uint64_t segment_offset = 0;
  std::uint64_t segment_line = 1;
  std::uint64_t offset = 0;
  std::uint64_t line = 1;
  friend bool operator==(const TextPosition&, const TextPosition&) = default;
};

/// Shows the text from a block's beginning to the end of its line, through windows of the source.
/// Memory is one line. Any other use of the source makes the window stale: call `forget`.
class TextCursor {
 public:
  enum class State : std::uint8_t { Ready, NotYet, EndOfText, TooLong, Failed };

  /// `comments_span_lines`: a LF within parentheses ends no block.
  TextCursor(ProgramSource& source, bool comments_span_lines)
      : source_(&source), comments_span_lines_(comments_span_lines) {}

  State load(const TextPosition& position) {
    if (position.program == program_ && position.offset >= base_ && position.offset < limit_) {
      const char* at = window_ + (position.offset - base_);
      const char* end = find_end(at, window_ + (limit_ - base_));
      if (end != nullptr && end - at <= kLongest) {
        begin_ = at;
        end_ = end;
        offset_ = position.offset;
        is_terminated_ = true;
        return State::Ready;
      }
    }
    return load_from_source(position);
  }

  const char* begin() const { return begin_; }
  /// The LF that ends the line; it can be read.
  const char* end() const { return end_; }
  /// Of the block's first byte in its program.
  std::uint64_t offset() const { return offset_; }
  const std::string& failure() const { return failure_; }

  /// Moves `position` behind the block that ends at `block_end`, a semicolon or the line's end.
  void advance(TextPosition& position, const char* block_end) const {
    const bool at_line_end = block_end == end_;
    position.offset = offset_ + static_cast<std::uint64_t>(block_end - begin_) +
                      (!at_line_end || is_terminated_ ? 1 : 0);
    position.line += at_line_end ? 1 : 0;
    if (comments_span_lines_) [[unlikely]] {
      for (const char* at = begin_; at != block_end; ++at) position.line += *at == '\n';
    }
  }

  void forget() { limit_ = base_; }

 private:
  static constexpr std::ptrdiff_t kLongest = kMaxLineBytes;

  const char* find_end(const char* at, const char* limit) const {
    if (comments_span_lines_) [[unlikely]]
      return find_end_outside_comments(at, limit);
    return static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(limit - at)));
  }
  static const char* find_end_outside_comments(const char* at, const char* limit);
  State load_from_source(const TextPosition& position);
  State take_last_line(const char* at, std::size_t size);

  ProgramSource* source_;
  bool comments_span_lines_;
  const char* window_ = nullptr;
  std::uint64_t base_ = 0;   ///< offset of window_[0]
  std::uint64_t limit_ = 0;  ///< offset behind the window
  ProgramIndex program_ = kMainProgram;
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
  std::uint64_t offset_ = 0;
  bool is_terminated_ = false;
  std::array<char, kMaxLineBytes + 1> last_line_{};  ///< a last line without its end, with one
  std::string failure_;
  struct Place {
    ProgramIndex program = kMainProgram;
    std::uint64_t offset = 0;
  };
  Place wanted_at_;         ///< where the source was asked last,
  std::size_t wanted_ = 1;  ///< and for how much
};

}  // namespace dripline::interpreter::fanuc
