#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "gateway/interpreter/centurion/characters.hpp"
#include "gateway/interpreter/program_source.hpp"

namespace dripline::interpreter::centurion {

/// Longest block; a longer one is an alarm, so that a file without line ends needs no memory.
inline constexpr std::size_t kMaxBlockBytes = 4096;

/// A place between two blocks. `segment` is where the program begins that this text belongs to: a
/// file may hold several, each beginning with an O line (spec 20.2).
struct TextPosition {
  ProgramIndex program = kMainProgram;
  bool after_cr = false;   ///< the block before ended with CR: a LF here still belongs to it
  bool code_seen = false;  ///< a block with code has been passed: an O line now ends the program
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
/// use of the source makes the window stale: call `forget`.
class TextCursor {
 public:
  enum class State : std::uint8_t { Ready, NotYet, EndOfText, TooLong, Failed };

  explicit TextCursor(ProgramSource& source) : source_(&source) {}

  /// Makes the block at `position` visible; asks the source for as little as a block needs.
  State load(const TextPosition& position) {
    if (position.program == program_ && position.offset >= base_ && position.offset < limit_) {
      const char* at = window_ + (position.offset - base_);
      if (position.after_cr && *at == '\n') ++at;
      const char* end = find_end_of_block(at, window_ + (limit_ - base_));
      if (end != window_ + (limit_ - base_) && end - at <= kLongest) {
        begin_ = at;
        end_ = end;
        offset_ = base_ + static_cast<std::uint64_t>(at - window_);
        is_terminated_ = true;
        return State::Ready;
      }
    }
    return load_from_source(position);
  }

  /// The block; `*end()` can be read and ends a block.
  const char* begin() const { return begin_; }
  const char* end() const { return end_; }
  /// Of the block's first byte in its program.
  std::uint64_t offset() const { return offset_; }
  const std::string& failure() const { return failure_; }

  /// Moves `position` behind the block that is visible.
  void advance(TextPosition& position) const {
    position.offset = offset_ + static_cast<std::uint64_t>(end_ - begin_) + is_terminated_;
    position.after_cr = is_terminated_ && *end_ == '\r';
    ++position.line;
  }

  void forget() { limit_ = base_; }

 private:
  static constexpr std::ptrdiff_t kLongest = kMaxBlockBytes;
  State load_from_source(const TextPosition& position);
  State take_last_block(const char* at, std::size_t size);

  ProgramSource* source_;
  const char* window_ = nullptr;
  std::uint64_t base_ = 0;   ///< offset of window_[0]
  std::uint64_t limit_ = 0;  ///< offset behind the window
  ProgramIndex program_ = kMainProgram;
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
  std::uint64_t offset_ = 0;
  bool is_terminated_ = false;
  std::array<char, kMaxBlockBytes + 1> last_block_{};  ///< a last block without line end, with one
  std::string failure_;
  struct Place {
    ProgramIndex program = kMainProgram;
    std::uint64_t offset = 0;
  };
  Place wanted_at_;         ///< where the source was asked last,
  std::size_t wanted_ = 1;  ///< and for how much
};

}  // namespace dripline::interpreter::centurion
