#include "gateway/interpreter/tnc155/text_search.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The characters of a line without blanks and controls.
class Characters {
 public:
  explicit Characters(std::string_view line) : line_(line) { skip(); }
  char peek() const { return at_ < line_.size() ? line_[at_] : '\0'; }
  void advance() {
    ++at_;
    skip();
  }
  bool take(char c) {
    if (peek() != c) return false;
    advance();
    return true;
  }
  bool take(std::string_view word) {
    const std::size_t start = at_;
    for (const char c : word) {
      if (take(c)) continue;
      at_ = start;
      return false;
    }
    return true;
  }
  /// Digits; -1 when there are none.
  std::int64_t number() {
    if (!is_digit(peek())) return -1;
    std::int64_t value = 0;
    for (; is_digit(peek()); advance()) {
      if (value < 1'000'000'000) value = value * 10 + (peek() - '0');
    }
    return value;
  }

 private:
  void skip() {
    while (at_ < line_.size() && static_cast<unsigned char>(line_[at_]) <= ' ') ++at_;
  }
  std::string_view line_;
  std::size_t at_ = 0;
};

/// G98 and its L stand anywhere in an ISO block.
void read_iso(Characters& text, LineHead& head) {
  bool sets_label = false;
  std::int64_t label = -1;
  while (text.peek() != '\0') {
    const char letter = text.peek();
    text.advance();
    if (letter == '*') head.ends_block = true;
    if (letter != 'G' && letter != 'L') continue;
    const std::int64_t number = text.number();
    if (letter == 'L') label = number;
    sets_label |= letter == 'G' && number == 98;
  }
  if (sets_label) head.label = static_cast<std::int32_t>(label);
}

}  // namespace

LineHead read_head(std::string_view line) {
  LineHead head;
  Characters text(line);
  const char first = text.peek();
  if (first == 'N' || first == '%') {
    text.advance();
    head.begins_block = true;
    const std::int64_t number = text.number();
    if (first == 'N') head.number = number;
    read_iso(text, head);
    return head;
  }
  head.begins_block = is_digit(first);
  head.number = text.number();
  if (text.take("LBL")) {
    head.label = static_cast<std::int32_t>(text.number());
    return head;
  }
  if (!head.begins_block) read_iso(text, head);
  return head;
}

/// As the reader cuts blocks: behind a block without a number every line does that is not indented.
bool TextSearch::begins_block(const Index& index, std::string_view line, const LineHead& head) {
  if (head.begins_block || index.after_end) return true;
  const bool is_indented = line.empty() || line.front() == ' ' || line.front() == '\t';
  return !index.is_numbered && !is_indented;
}

TextSearch::TextSearch(ProgramSource& source)
    : lines_(source, LineRules{.max_bytes = 4096, .skip_percent = false}) {}

TextSearch::Index& TextSearch::index_of(ProgramIndex program) {
  Index* oldest = &indexes_[0];
  for (Index& index : indexes_) {
    if (index.is_used && index.next.program == program) {
      index.last_use = ++uses_;
      return index;
    }
    if (index.last_use < oldest->last_use) oldest = &index;
  }
  *oldest = Index{};
  oldest->is_used = true;
  oldest->last_use = ++uses_;
  oldest->next.program = program;
  return *oldest;
}

TextSearch::Outcome TextSearch::next_line(TextPlace& next, SourceLine& line) {
  lines_.seek(next);
  switch (lines_.next(line)) {
    case LineState::Ready:
      next = lines_.place();
      return Outcome::Found;
    case LineState::End:
      return Outcome::Missing;
    case LineState::NotYet:
      return Outcome::NotYet;
    case LineState::TooLong:
      reason_ = "a line of more than 4096 characters, met in a search";
      return Outcome::Failed;
    case LineState::Failed:
      break;
  }
  reason_ = lines_.reason();
  return Outcome::Failed;
}

TextSearch::Outcome TextSearch::find_label(ProgramIndex program, std::uint32_t label,
                                           TextPlace& found) {
  if (label >= kLabels) return Outcome::Missing;
  lines_.forget_window();
  Index& index = index_of(program);
  for (unsigned count = 0; count < kLinesPerCall; ++count) {
    if (const auto& place = index.labels[label]) {
      found = *place;
      return Outcome::Found;
    }
    if (index.is_complete) return Outcome::Missing;
    SourceLine line;
    const Outcome read = next_line(index.next, line);
    if (read == Outcome::Missing) index.is_complete = true;
    if (read == Outcome::Missing) continue;
    if (read != Outcome::Found) return read;
    const LineHead head = read_head(line.text);
    if (begins_block(index, line.text, head)) {
      index.block = line.place;
      index.is_numbered = head.begins_block;
    }
    index.after_end = head.ends_block;
    if (head.label >= 0 && static_cast<std::size_t>(head.label) < kLabels) {
      auto& place = index.labels[static_cast<std::size_t>(head.label)];
      if (!place) place = index.block;
    }
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_block(std::uint32_t number, TextPlace& found) {
  lines_.forget_window();
  if (block_number_ != number) block_next_ = TextPlace{};
  block_number_ = number;
  for (unsigned count = 0; count < kLinesPerCall; ++count) {
    SourceLine line;
    const Outcome read = next_line(block_next_, line);
    if (read != Outcome::Found) return read;
    const LineHead head = read_head(line.text);
    if (head.number != number) continue;
    found = line.place;
    return Outcome::Found;
  }
  return Outcome::More;
}

}  // namespace dripline::interpreter::tnc155
