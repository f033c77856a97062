#include "gateway/interpreter/dialects/tnc155/reading/text_search.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/core/language/spelling.hpp"

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

}  // namespace

BlockHead read_head(std::string_view block, Form form) {
  BlockHead head;
  Characters text(block);
  if (form == Form::Iso) {
    if (text.take('N')) head.number = text.number();
    head.label = label_of_iso(block);
    return head;
  }
  head.number = text.number();
  if (text.take("LBL")) head.label = static_cast<std::int32_t>(text.number());
  return head;
}

namespace {

/// The label that a block of a later control sets, as the text has it; empty: none.
std::string later_label(std::string_view block) {
  block = block.substr(0, block.find(';'));
  std::size_t at = 0;
  const auto skip = [&](bool also_digits) {
    while (at < block.size() && (static_cast<unsigned char>(block[at]) <= ' ' ||
                                 (also_digits && language::is_digit(block[at])))) {
      ++at;
    }
  };
  skip(true);
  if (!block.substr(at).starts_with("LBL")) return {};
  at += 3;
  skip(false);
  if (at < block.size() && block[at] == '"') {
    const std::size_t end = block.find('"', at + 1);
    return end == std::string_view::npos ? std::string()
                                         : std::string(block.substr(at, end + 1 - at));
  }
  const std::int64_t number = Characters(block.substr(at)).number();
  return number > 0 ? fmt::format("{}", number) : std::string();
}

}  // namespace

TextSearch::TextSearch(ProgramSource& source, ReaderOptions options)
    : reader_(source, options), is_later_(options.is_later) {}

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

template <class Known, class Note>
TextSearch::Outcome TextSearch::search(Index& index, Known known, Note note, TextPlace& found) {
  for (unsigned count = 0; count < kBlocksPerCall; ++count) {
    if (const TextPlace* place = known()) {
      found = *place;
      return Outcome::Found;
    }
    if (index.is_complete) return Outcome::Missing;
    std::string_view text;
    const Outcome read = next_block(index.progress, text);
    if (read == Outcome::Missing) index.is_complete = true;
    if (read == Outcome::Missing) continue;
    if (read != Outcome::Found) return read;
    note(text);
  }
  return Outcome::More;
}

TextSearch::Outcome TextSearch::find_later_label(Index& index, const std::string& label,
                                                 TextPlace& found) {
  const auto known = [&]() -> const TextPlace* {
    const auto place = index.others.find(label);
    return place == index.others.end() ? nullptr : &place->second;
  };
  const auto note = [&](std::string_view text) {
    if (std::string set = later_label(text); !set.empty())
      index.others.try_emplace(std::move(set), reader_.block_place());
  };
  return search(index, known, note, found);
}

TextSearch::Outcome TextSearch::find_label(ProgramIndex program, std::uint32_t label,
                                           std::string_view name, TextPlace& found) {
  if (is_later_) {
    reader_.drop_window();
    return find_later_label(index_of(program),
                            name.empty() ? fmt::format("{}", label) : fmt::format("\"{}\"", name),
                            found);
  }
  if (label >= kLabels) return Outcome::Missing;
  reader_.drop_window();
  Index& index = index_of(program);
  const auto known = [&]() -> const TextPlace* {
    const auto& place = index.labels[label];
    return place ? &*place : nullptr;
  };
  const auto note = [&](std::string_view text) {
    const std::int32_t set = read_head(text, index.progress.state.program.form).label;
    if (set < 0 || static_cast<std::size_t>(set) >= kLabels) return;
    auto& place = index.labels[static_cast<std::size_t>(set)];
    if (!place) place = reader_.block_place();
  };
  return search(index, known, note, found);
}

}  // namespace dripline::interpreter::tnc155
