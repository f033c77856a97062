#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <utility>

namespace dripline::machine::grbl {

/// Character counting: the bytes of all lines without an answer never exceed the board's receive
/// buffer. Each line has exactly one answer, in order. Real-time bytes are not lines. Pure.
class CharacterCounter {
 public:
  void set_window(std::size_t bytes) { window_ = bytes; }
  std::size_t window() const { return window_; }
  /// `line` with its end.
  bool fits(std::size_t bytes) const { return unanswered_ + bytes <= window_; }
  void sent(std::string line) {
    unanswered_ += line.size();
    lines_.push_back(std::move(line));
  }
  /// The board has answered its oldest line, which is returned; false: there was none.
  bool answered(std::string& line) {
    if (lines_.empty()) return false;
    line = std::move(lines_.front());
    lines_.pop_front();
    unanswered_ -= line.size();
    return true;
  }
  std::size_t unanswered_bytes() const { return unanswered_; }
  std::size_t unanswered_lines() const { return lines_.size(); }
  /// The board has dropped what it had (a reset).
  void reset() { lines_.clear(), unanswered_ = 0; }

 private:
  std::size_t window_ = 0, unanswered_ = 0;
  std::deque<std::string> lines_;
};

}  // namespace dripline::machine::grbl
