#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::interpreter::language {

/// Shows the text from any offset of a program to the end of its line, through windows of the
/// source, for dialects whose lines end with a character that they may read (so that no function
/// below checks for the end of the text). The caller decides what ends a line: `FindEnd` gives the
/// first place in [at, limit) that does, or `limit`. Memory is one line. Any other use of the
/// source makes the window stale: call `invalidate`. A byte order mark before a program is skipped.
/// `LineReader` is the simpler reader of lines.
class LineWindow {
 public:
  enum class State : std::uint8_t { Ready, NotYet, EndOfText, TooLong, Failed };

  LineWindow(ProgramSource& source, std::size_t longest) : source_(&source), longest_(longest) {}

  /// Makes the line visible that begins at `offset`; asks the source for as little as a line needs.
  template <class FindEnd>
  State load(ProgramIndex program, std::uint64_t offset, FindEnd find_end) {
    if (program == program_ && offset >= base_ && offset < limit_) {
      const char* at = window_ + (offset - base_);
      const char* limit = window_ + (limit_ - base_);
      const char* end = find_end(at, limit);
      if (end != limit && static_cast<std::size_t>(end - at) <= longest_) {
        show(at, end, offset);
        return State::Ready;
      }
    }
    return load_from_source(program, offset, find_end);
  }

  /// The line; `*end()` can be read and ends it.
  const char* begin() const { return begin_; }
  const char* end() const { return end_; }
  /// The offset of the line's first byte in its program.
  std::uint64_t offset() const { return offset_; }
  /// False for a last line that ends with the program instead of a character; `*end()` is a LF
  /// then.
  bool is_terminated() const { return is_terminated_; }
  const std::string& failure() const { return failure_; }

  void invalidate() { limit_ = base_; }

 private:
  void show(const char* at, const char* end, std::uint64_t offset) {
    if (offset == 0) [[unlikely]] {  // an editor's byte order mark is no part of the program
      const std::size_t mark = byte_order_mark({at, static_cast<std::size_t>(end - at)});
      at += mark;
      offset += mark;
    }
    begin_ = at;
    end_ = end;
    offset_ = offset;
    is_terminated_ = true;
  }

  template <class FindEnd>
  State load_from_source(ProgramIndex program, std::uint64_t offset, FindEnd find_end) {
    for (std::size_t wanted = first_wish(program, offset);;) {
      std::string_view text;
      bool reaches_end = false;
      const State fetched = fetch(program, offset, wanted, text, reaches_end);
      if (fetched != State::Ready) return fetched;
      const char* limit = text.data() + text.size();
      const char* end = text.empty() ? limit : find_end(text.data(), limit);
      if (static_cast<std::size_t>(end - text.data()) > longest_) return State::TooLong;
      if (end != limit) {
        keep(program, offset, text);
        show(text.data(), end, offset);
        return State::Ready;
      }
      if (reaches_end) return take_last_line(text, offset);
      if (text.size() < wanted) return fail_early();
      wanted = text.size() + 1;
    }
  }

  static std::size_t byte_order_mark(std::string_view line) {
    constexpr std::string_view kUtf8 = "\xEF\xBB\xBF";
    return line.starts_with(kUtf8) ? kUtf8.size() : 0;
  }

  std::size_t first_wish(ProgramIndex program, std::uint64_t offset);
  State fetch(ProgramIndex program, std::uint64_t offset, std::size_t wanted,
              std::string_view& text, bool& reaches_end);
  void keep(ProgramIndex program, std::uint64_t offset, std::string_view text);
  State take_last_line(std::string_view text, std::uint64_t offset);
  State fail_early();

  ProgramSource* source_;
  std::size_t longest_;
  const char* window_ = nullptr;
  std::uint64_t base_ = 0;   ///< offset of window_[0]
  std::uint64_t limit_ = 0;  ///< offset after the window
  ProgramIndex program_ = kMainProgram;
  const char* begin_ = nullptr;
  const char* end_ = nullptr;
  std::uint64_t offset_ = 0;
  bool is_terminated_ = false;
  std::string last_line_;  ///< a last line without its end, with one
  std::string failure_;
  struct Place {
    ProgramIndex program = kMainProgram;
    std::uint64_t offset = 0;
  };
  Place wanted_at_;         ///< where the source was asked last,
  std::size_t wanted_ = 1;  ///< and for how much
};

/// How far a search in text that may still be arriving has come.
enum class SearchOutcome : std::uint8_t {
  Found,
  Missing,
  NotYet,   ///< the source has to give more text
  More,     ///< a bounded piece of work is done; call again
  TooLong,  ///< a line or a block is longer than the limit
  Failed,   ///< the source failed
  Crossed,  ///< a loop's begin and end do not belong together
};
/// Of a search whose next line was loaded with this result.
constexpr SearchOutcome outcome_of(LineWindow::State state) {
  constexpr SearchOutcome kOutcomes[] = {SearchOutcome::Found, SearchOutcome::NotYet,
                                         SearchOutcome::Missing, SearchOutcome::TooLong,
                                         SearchOutcome::Failed};
  return kOutcomes[static_cast<std::size_t>(state)];
}

}  // namespace dripline::interpreter::language
