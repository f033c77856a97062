#include "gateway/interpreter/core/language/line_window.hpp"

namespace dripline::interpreter::language {

/// Whatever is there: a slow line must not wait for bytes it need not have. A place that was met
/// before with too little continues from what it asked for then.
std::size_t LineWindow::first_wish(ProgramIndex program, std::uint64_t offset) {
  const bool is_same = wanted_at_.program == program && wanted_at_.offset == offset;
  wanted_at_ = {program, offset};
  return is_same ? wanted_ : 1;
}

LineWindow::State LineWindow::fetch(ProgramIndex program, std::uint64_t offset, std::size_t wanted,
                                    std::string_view& text, bool& reaches_end) {
  const TextWindow window = source_->fetch(program, offset, wanted);
  invalidate();
  wanted_ = wanted;
  if (window.state == TextWindow::State::NotYet) return State::NotYet;
  if (window.state == TextWindow::State::Failed) {
    failure_ = window.reason;
    return State::Failed;
  }
  text = window.text.substr(0, ProgramSource::kMaxWindow);
  reaches_end = window.reaches_end && text.size() == window.text.size();
  return State::Ready;
}

void LineWindow::keep(ProgramIndex program, std::uint64_t offset, std::string_view text) {
  window_ = text.data();
  program_ = program;
  base_ = offset;
  limit_ = offset + text.size();
}

LineWindow::State LineWindow::take_last_line(std::string_view text, std::uint64_t offset) {
  if (text.empty()) return State::EndOfText;
  last_line_ = text;
  last_line_ += '\n';
  show(last_line_.data(), last_line_.data() + text.size(), offset);
  is_terminated_ = false;
  return State::Ready;
}

LineWindow::State LineWindow::fail_early() {
  failure_ = "the program's text ends early";
  return State::Failed;
}

}  // namespace dripline::interpreter::language
