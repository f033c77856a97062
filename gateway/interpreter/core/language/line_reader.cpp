#include "gateway/interpreter/core/language/line_reader.hpp"

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter {

LineReader::LineReader(ProgramSource& source, LineRules rules) : source_(source), rules_(rules) {
  invariant(rules_.max_bytes > 0 && rules_.max_bytes + 2 <= ProgramSource::kMaxWindow,
            "a line and its end fit into one window");
}

bool LineReader::is_only_percent(std::size_t length) const {
  for (const char c : std::string_view(cursor_, length)) {
    if (c != '%' && c != ' ' && c != '\t') return false;
  }
  return true;
}

LineState LineReader::next_slowly(SourceLine& line) {
  while (true) {
    std::size_t length = 0;
    std::size_t consumed = 0;
    bool found = find_line(length, consumed);
    if (!found && reaches_end_ && available() <= rules_.max_bytes) {
      if (available() == 0) return LineState::End;
      length = consumed = available();  // the last line has no end of its own
      found = true;
    }
    if (found && length <= rules_.max_bytes) {
      if (!is_percent(length)) {
        deliver(line, length, consumed);
        return LineState::Ready;
      }
      advance(consumed);
      continue;
    }
    // A CR may still follow within the byte after the longest line.
    if (found || available() > rules_.max_bytes + 1) return LineState::TooLong;
    if (const LineState state = fetch_more(); state != LineState::Ready) return state;
  }
}

LineState LineReader::fetch_more() {
  const std::size_t have = available();
  if (reaches_end_ && cursor_) return LineState::TooLong;  // one byte over the limit, and no end
  // After NotYet the window is gone, but not the knowledge that its text was too little.
  const bool same_line = wanted_at_ == place_;
  wanted_ = same_line && wanted_ > have ? wanted_ : have + 1;
  wanted_at_ = place_;
  TextWindow window = source_.fetch(place_.program, place_.offset, wanted_);
  drop_window();
  if (window.state == TextWindow::State::NotYet) return LineState::NotYet;
  if (window.state == TextWindow::State::Failed) {
    reason_ = std::move(window.reason);
    return LineState::Failed;
  }
  if (window.text.size() <= have && !window.reaches_end) {
    reason_ = "the source gave less text than it was asked for";
    return LineState::Failed;
  }
  // An empty view may have no data; the cursor distinguishes "no window" from "nothing left".
  begin_ = cursor_ = window.text.data() ? window.text.data() : "";
  end_ = begin_ + window.text.size();
  reaches_end_ = window.reaches_end;
  return LineState::Ready;
}

void LineReader::seek(const TextPlace& place) {
  const std::uint64_t window_offset = place_.offset - static_cast<std::uint64_t>(cursor_ - begin_);
  const auto window_size = static_cast<std::uint64_t>(end_ - begin_);
  const bool inside = begin_ && place.program == place_.program && place.offset >= window_offset &&
                      place.offset <= window_offset + window_size;
  if (inside) {
    cursor_ = begin_ + (place.offset - window_offset);
  } else {
    drop_window();
  }
  place_ = place;
}

ProgramLookup LineReader::find(std::string_view name) {
  const std::string kept(name);  // it may lie in the window
  drop_window();
  return source_.find(kept);
}

void LineReader::drop_window() {
  begin_ = cursor_ = end_ = nullptr;
  cr_free_begin_ = cr_free_end_ = nullptr;
  reaches_end_ = false;
}

}  // namespace dripline::interpreter
