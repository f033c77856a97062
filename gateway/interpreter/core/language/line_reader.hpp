#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::interpreter {

/// The place where a line begins. A dialect keeps it to come back: labels, loops, return addresses,
/// snapshots.
struct TextPlace {
  ProgramIndex program = kMainProgram;
  std::uint64_t offset = 0;  ///< bytes from the start of the program
  std::uint64_t line = 1;    ///< 1-based
  friend bool operator==(const TextPlace&, const TextPlace&) = default;
};

struct SourceLine {
  std::string_view text;  ///< without its end; valid until the next call on reader or source
  TextPlace place;        ///< of its first byte
};

struct LineRules {
  std::size_t max_bytes = 4096;  ///< of a line without its end; at most kMaxWindow - 2
  bool skip_percent = true;      ///< lines of nothing but `%` and blanks are counted, not delivered
};

enum class LineState : std::uint8_t {
  Ready,
  End,      ///< the program has no more lines
  NotYet,   ///< the rest of this line is not here yet; ask again later
  Failed,   ///< the source will never give it; see `reason()`
  TooLong,  ///< over LineRules::max_bytes; the place stays before the line
};

/// Cuts a program into lines, whatever the windows it comes in: the same text gives the same lines
/// and places for every chunking. A line ends with LF, CR LF, CR or the end of the program. Only
/// Ready moves the place. Memory: none of its own; a line always lies in one window of the source.
/// The source must outlive the reader; after any other call of fetch or find on it, the owner calls
/// `drop_window()` before the reader's next call.
class LineReader {
 public:
  explicit LineReader(ProgramSource& source, LineRules rules = {});

  /// The next line. Inline for the case that matters: the whole line lies in the window at hand.
  LineState next(SourceLine& line) {
    std::size_t length = 0;
    std::size_t consumed = 0;
    if (find_line(length, consumed) && length <= rules_.max_bytes && !is_percent(length)) {
      deliver(line, length, consumed);
      return LineState::Ready;
    }
    return next_slowly(line);
  }

  /// Where the next line begins.
  const TextPlace& place() const { return place_; }
  /// Continues from there: `place` must be the beginning of a line. Cheap within the window at
  /// hand.
  void seek(const TextPlace& place);
  /// Looks a program up in the same source; the last line's text is no longer valid.
  ProgramLookup find(std::string_view name);
  /// Drops the window, because the source may have been called by others; the place stays.
  void drop_window();

  /// Why the last call gave Failed.
  const std::string& reason() const { return reason_; }

 private:
  std::size_t available() const { return static_cast<std::size_t>(end_ - cursor_); }

  /// True when a line and its end lie in the window. A CR at the very end of the window may be half
  /// of a CR LF, so it ends no line unless the program ends there.
  bool find_line(std::size_t& length, std::size_t& consumed) const {
    const std::size_t room = available();
    if (room == 0) return false;
    // Two more bytes than allowed are enough to see that a line is too long.
    const std::size_t seen = room < rules_.max_bytes + 2 ? room : rules_.max_bytes + 2;
    const auto* lf = static_cast<const char*>(std::memchr(cursor_, '\n', seen));
    const std::size_t before = lf ? static_cast<std::size_t>(lf - cursor_) : seen;
    if (const char* cr = find_cr(before)) {
      length = static_cast<std::size_t>(cr - cursor_);
      if (cr + 1 == end_ && !reaches_end_) return false;
      consumed = length + (cr + 1 != end_ && cr[1] == '\n' ? 2 : 1);
      return true;
    }
    if (!lf) return false;
    length = before;
    consumed = before + 1;
    return true;
  }

  /// Within so many bytes. Most programs have none, so that looking well ahead saves the next lines
  /// the search.
  const char* find_cr(std::size_t before) const {
    if (cursor_ < cr_free_begin_ || cursor_ + before > cr_free_end_) {
      constexpr std::size_t kAhead = 4096;
      const std::size_t seen = available() < kAhead || before > kAhead ? before : kAhead;
      const auto* cr = static_cast<const char*>(std::memchr(cursor_, '\r', seen));
      cr_free_begin_ = cursor_;
      cr_free_end_ = cr ? cr : cursor_ + seen;
    }
    return cursor_ + before <= cr_free_end_ ? nullptr : cr_free_end_;
  }

  bool is_percent(std::size_t length) const {
    return length != 0 && *cursor_ == '%' && rules_.skip_percent && is_only_percent(length);
  }

  void deliver(SourceLine& line, std::size_t length, std::size_t consumed) {
    line.text = std::string_view(cursor_, length);
    line.place = place_;
    advance(consumed);
  }
  void advance(std::size_t consumed) {
    cursor_ += consumed;
    place_.offset += consumed;
    ++place_.line;
  }

  bool is_only_percent(std::size_t length) const;
  LineState next_slowly(SourceLine& line);
  LineState fetch_more();

  ProgramSource& source_;
  LineRules rules_;
  TextPlace place_;
  const char* begin_ = nullptr;  ///< of the window
  const char* cursor_ = nullptr;
  const char* end_ = nullptr;
  /// Between these the window has no CR.
  mutable const char* cr_free_begin_ = nullptr;
  mutable const char* cr_free_end_ = nullptr;
  bool reaches_end_ = false;
  std::size_t wanted_ = 0;  ///< bytes last asked for,
  TextPlace wanted_at_;     ///< from here
  std::string reason_;
};

}  // namespace dripline::interpreter
