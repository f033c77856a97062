#include "gateway/interpreter/fanuc/text_cursor.hpp"

#include <algorithm>

namespace dripline::interpreter::fanuc {

const char* TextCursor::find_end_outside_comments(const char* at, const char* limit) {
  bool in_comment = false;
  for (; at != limit; ++at) {
    if (*at == '(') in_comment = true;
    if (*at == ')') in_comment = false;
    if (*at == '\n' && !in_comment) return at;
  }
  return nullptr;
}

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
    const char* at = text.data();
    const char* limit = at + text.size();
    const char* end = text.empty() ? nullptr : find_end(at, limit);
    if ((end != nullptr ? end : limit) - at > kLongest) return State::TooLong;
    offset_ = position.offset;
    if (end != nullptr) {
      window_ = at;
      program_ = position.program;
      base_ = position.offset;
      limit_ = base_ + text.size();
      begin_ = at;
      end_ = end;
      is_terminated_ = true;
      return State::Ready;
    }
    if (reaches_end) return take_last_line(at, text.size());
    if (text.size() < wanted) {
      failure_ = "the program's text ends early";
      return State::Failed;
    }
    wanted = text.size() + 1;
  }
}

TextCursor::State TextCursor::take_last_line(const char* at, std::size_t size) {
  if (size == 0) return State::EndOfText;
  std::copy(at, at + size, last_line_.begin());
  last_line_[size] = '\n';
  begin_ = last_line_.data();
  end_ = begin_ + size;
  is_terminated_ = false;
  return State::Ready;
}

}  // namespace dripline::interpreter::fanuc
