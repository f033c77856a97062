#include "gateway/interpreter/centurion/text_cursor.hpp"

#include <algorithm>

namespace dripline::interpreter::centurion {

TextCursor::State TextCursor::load_from_source(const TextPosition& position) {
  // Whatever is there: a slow line must not wait for bytes it need not have. A place that was met
  // before with too little goes on from what it asked for then.
  const bool is_same_place =
      wanted_at_.program == position.program && wanted_at_.offset == position.offset;
  std::size_t wanted = is_same_place ? wanted_ : 1;
  wanted_at_ = {position.program, position.offset};
  for (;;) {
    const TextWindow window = source_->fetch(position.program, position.offset, wanted);
    forget();
    wanted_ = wanted;
    if (window.state == TextWindow::State::NotYet) return State::NotYet;
    if (window.state == TextWindow::State::Failed) {
      failure_ = window.reason;
      return State::Failed;
    }
    const std::string_view text = window.text.substr(0, ProgramSource::kMaxWindow);
    const bool reaches_end = window.reaches_end && text.size() == window.text.size();
    const std::size_t skip = position.after_cr && !text.empty() && text[0] == '\n' ? 1 : 0;
    const char* at = text.data() + skip;
    const char* limit = text.data() + text.size();
    const char* end = find_end_of_block(at, limit);
    if (end - at > kLongest) return State::TooLong;
    offset_ = position.offset + skip;
    if (end != limit) {
      window_ = text.data();
      program_ = position.program;
      base_ = position.offset;
      limit_ = base_ + text.size();
      begin_ = at;
      end_ = end;
      is_terminated_ = true;
      return State::Ready;
    }
    if (reaches_end) return take_last_block(at, static_cast<std::size_t>(limit - at));
    if (text.size() < wanted) {
      failure_ = "the program's text ends early";
      return State::Failed;
    }
    wanted = text.size() + 1;
  }
}

TextCursor::State TextCursor::take_last_block(const char* at, std::size_t size) {
  if (size == 0) return State::EndOfText;
  std::copy(at, at + size, last_block_.begin());
  last_block_[size] = '\n';
  begin_ = last_block_.data();
  end_ = begin_ + size;
  is_terminated_ = false;
  return State::Ready;
}

}  // namespace dripline::interpreter::centurion
