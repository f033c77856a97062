#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "gateway/interpreter/core/language/line_window.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"

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

  /// Where this program begins. At the head of a text its leader is read again: the % there ends no
  /// record.
  TextPosition segment_head() const {
    TextPosition head = *this;
    head.offset = segment_offset;
    head.line = segment_line;
    head.head_seen = segment_offset != 0;
    head.code_seen = false;
    return head;
  }
};

/// Shows the text from a block's beginning to the LF that ends its line.
class TextCursor {
 public:
  using State = language::LineWindow::State;

  /// `comments_span_lines`: a LF within parentheses ends no block.
  TextCursor(ProgramSource& source, bool comments_span_lines)
      : window_(source, kMaxLineBytes), comments_span_lines_(comments_span_lines) {}

  State load(const TextPosition& position) {
    if (comments_span_lines_) [[unlikely]]
      return load_across_lines(position);
    return window_.load(position.program, position.offset, [](const char* at, const char* limit) {
      const void* end = std::memchr(at, '\n', static_cast<std::size_t>(limit - at));
      return end == nullptr ? limit : static_cast<const char*>(end);
    });
  }

  const char* begin() const { return window_.begin(); }
  /// The LF that ends the line; it can be read.
  const char* end() const { return window_.end(); }
  /// Of the block's first byte in its program.
  std::uint64_t offset() const { return window_.offset(); }
  const std::string& failure() const { return window_.failure(); }
  void invalidate() { window_.invalidate(); }

  /// Moves `position` after the block that ends at `block_end`, a semicolon or the line's end.
  void advance(TextPosition& position, const char* block_end) const {
    const bool at_line_end = block_end == end();
    position.offset = offset() + static_cast<std::uint64_t>(block_end - begin()) +
                      (!at_line_end || window_.is_terminated() ? 1 : 0);
    position.line += at_line_end ? 1 : 0;
    if (comments_span_lines_) [[unlikely]] {
      for (const char* at = begin(); at != block_end; ++at) position.line += *at == '\n';
    }
  }

 private:
  State load_across_lines(const TextPosition& position) {
    return window_.load(position.program, position.offset, [](const char* at, const char* limit) {
      bool in_comment = false;
      for (; at != limit; ++at) {
        if (*at == '(') in_comment = true;
        if (*at == ')') in_comment = false;
        if (*at == '\n' && !in_comment) return at;
      }
      return limit;
    });
  }

  language::LineWindow window_;
  bool comments_span_lines_;
};

}  // namespace dripline::interpreter::fanuc
