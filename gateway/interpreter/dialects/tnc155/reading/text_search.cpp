#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <limits>
#include <utility>

#include "gateway/interpreter/core/language/spelling.hpp"
#include "gateway/interpreter/dialects/tnc155/state.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// The characters of a block without blanks and controls.
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
  std::string_view rest() const { return line_.substr(at_); }
  /// Digits; -1 when there are none.
  std::int64_t number() {
    if (!language::is_digit(peek())) return -1;
    std::int64_t value = 0;
    for (; language::is_digit(peek()); advance()) {
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

/// G98 and its L may be anywhere in an ISO block; few blocks have an L.
std::int32_t label_of_iso(std::string_view block) {
  if (block.find('L') == std::string_view::npos) return -1;
  bool sets_label = false;
  std::int64_t label = -1;
  for (Characters text(block); text.peek() != '\0';) {
    const char letter = text.peek();
    text.advance();
    if (letter != 'G' && letter != 'L') continue;
    const std::int64_t number = text.number();
    if (letter == 'L') label = number;
    sets_label |= letter == 'G' && number == 98;
  }
  return sets_label ? static_cast<std::int32_t>(label) : -1;
}

/// After LBL: what is between two quotes.
std::string_view quoted(std::string_view rest) {
  const std::size_t end = rest.find('"', 1);
  return end == std::string_view::npos ? std::string_view() : rest.substr(1, end - 1);
}

}  // namespace

BlockHead read_head(std::string_view block, Form form) {
  BlockHead head;
  Characters text(block);
  if (form == Form::Iso) {
    if (text.take('N')) head.number = text.number();
    head.label = label_of_iso(block);
    return head;
  }
  head.is_skipped = text.take('/');
  head.number = text.number();
  head.is_skipped = head.is_skipped || text.take('/');
  if (text.take("LBL")) {
    head.label = static_cast<std::int32_t>(text.number());
    if (text.peek() == '"') head.name = quoted(text.rest());
  } else {
    head.is_end = !head.is_skipped && text.take("ENDPGM");
  }
  return head;
}

/// A line of the block after its first one that sets a label: 0, or its place in `block`. With `~`
/// at its end a line continues in the next one.
std::size_t continued_label(std::string_view block) {
  for (std::size_t end = block.find('\n'); end != std::string_view::npos;
       end = block.find('\n', end + 1)) {
    const BlockHead head = read_head(block.substr(end + 1), Form::Plain);
    if (head.label >= 0 || !head.name.empty()) return end + 1;
  }
  return 0;
}

std::string LabelSet::text() const {
  return block < 0 ? fmt::format("line {}", at.line)
                   : fmt::format("block {} (line {})", block, at.line);
}

TextSearch::TextSearch(ProgramSource& source, ReaderOptions options)
    : reader_(source, options), is_itnc_(options.is_itnc) {}

TextSearch::Index& TextSearch::index_of(ProgramIndex program) {
  Index* oldest = &indexes_[0];
  for (Index& index : indexes_) {
    if (index.is_used && index.progress.next.program == program) {
      index.last_use = ++uses_;
      return index;
    }
    if (index.last_use < oldest->last_use) oldest = &index;
  }
  *oldest = Index{};
  oldest->is_used = true;
  oldest->last_use = ++uses_;
  oldest->progress.next.program = program;
  return *oldest;
}

TextSearch::Outcome TextSearch::next_block(Progress& progress, std::string_view& text) {
  reader_.seek(progress.next);
  switch (reader_.pass(progress.state, text)) {
    case ReadState::Ready:
      progress.next = reader_.place();
      return Outcome::Found;
    case ReadState::End:
      return Outcome::Missing;
    case ReadState::NotYet:
      return Outcome::NotYet;
    case ReadState::Wrong:
      reason_ =
          fmt::format("line {}: {}, met in a search", reader_.fault_line(), reader_.fault().text());
      return Outcome::Failed;
    case ReadState::Failed:
      break;
  }
  reason_ = reader_.reason();
  return Outcome::Failed;
}

/// One large index at a time.
void TextSearch::make_room(const Index& index) {
  for (Index& other : indexes_) {
    if (&other != &index && other.numbers.size() + other.names.size() > kLargeIndex) other = {};
  }
}

void TextSearch::note_label(Index& index, const BlockHead& head, const LabelSet& set) {
  const auto keep = [&](auto& labels, auto key, const std::string& shown) {
    const auto [at, is_new] = labels.try_emplace(std::move(key), set);
    if (is_new) return;
    index.doubled =
        fmt::format("LBL {} is set in {} and in {}", shown, at->second.text(), set.text());
  };
  if (!head.name.empty()) {
    index.name_bytes += head.name.size();
    keep(index.names, std::string(head.name), fmt::format("\"{}\"", head.name));
  } else {
    keep(index.numbers, static_cast<std::uint32_t>(head.label), fmt::format("{}", head.label));
  }
  const bool is_too_many = index.names.size() > kMaxNames || index.name_bytes > kMaxNameBytes;
  if (is_too_many && index.doubled.empty()) {
    index.doubled = fmt::format("more than {} labels with names, or {} characters in them",
                                kMaxNames, kMaxNameBytes);
  }
  index.second = set;
  if (index.numbers.size() + index.names.size() == kLargeIndex + 1) make_room(index);
}

void TextSearch::note(Index& index, std::string_view text) {
  ++index.blocks;
  const BlockHead head = read_head(text, index.progress.state.program.form);
  index.is_complete = head.is_end;
  if (const std::size_t at = is_itnc_ ? continued_label(text) : 0; at != 0) [[unlikely]] {
    const std::string_view rest = text.substr(at);
    index.second = {reader_.block_place(), head.number};
    index.doubled = fmt::format("a label behind ~, in the continuation of {}: {}",
                                index.second.text(), rest.substr(0, rest.find_first_of("\r\n")));
    index.second.at.line +=
        static_cast<std::uint64_t>(std::ranges::count(text.substr(0, at), '\n'));
    return;
  }
  if (head.is_skipped) {
    if (!is_itnc_ || (head.label < 0 && head.name.empty())) return;
    index.doubled = fmt::format("a label behind a slash: {}", text);
    index.second = {reader_.block_place(), head.number};
    return;
  }
  const std::int32_t last = is_itnc_ ? kLastItncLabel : kLastLabel;
  const bool is_name = is_itnc_ && !head.name.empty();
  if (!is_name && (head.label <= 0 || head.label > last)) return;
  note_label(index, head, {reader_.block_place(), head.number});
}

/// To the end of the program, or of so many blocks.
TextSearch::Outcome TextSearch::search(Index& index, std::uint64_t blocks) {
  for (unsigned count = 0; count < kBlocksPerCall; ++count) {
    if (!index.doubled.empty()) {
      reason_ = index.doubled;
      second_ = index.second;
      return Outcome::Doubled;
    }
    if (index.is_complete || index.blocks >= blocks) return Outcome::Found;
    std::string_view text;
    const Outcome read = next_block(index.progress, text);
    if (read == Outcome::Missing) {
      index.is_complete = true;
    } else if (read != Outcome::Found) {
      return read;
    } else {
      note(index, text);
    }
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::check_labels(ProgramIndex program, std::uint64_t blocks) {
  reader_.drop_window();
  return search(index_of(program), blocks);
}

TextSearch::Outcome TextSearch::find_label(ProgramIndex program, std::uint32_t label,
                                           std::string_view name, TextPlace& found) {
  reader_.drop_window();
  Index& index = index_of(program);
  const Outcome outcome = search(index, std::numeric_limits<std::uint64_t>::max());
  if (outcome != Outcome::Found) return outcome;
  const LabelSet* set = nullptr;
  if (name.empty()) {
    const auto at = index.numbers.find(label);
    if (at != index.numbers.end()) set = &at->second;
  } else {
    const auto at = index.names.find(name);
    if (at != index.names.end()) set = &at->second;
  }
  if (!set) return Outcome::Missing;
  found = set->at;
  return Outcome::Found;
}

}  // namespace dripline::interpreter::tnc155
