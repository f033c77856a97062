#include "gateway/line/heads/modal_scan.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "gateway/interpreter/registry.hpp"

namespace dripline::line {

namespace {

using TextKind = interpreter::TextForm::Kind;

constexpr std::uint64_t kMaxLooked = 5000;
constexpr std::size_t kMaxUnknown = 8;

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
bool is_letter(char c) {
  return upper(c) >= 'A' && upper(c) <= 'Z';
}
bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A block without the N number at its beginning.
std::string_view without_number(std::string_view block) {
  if (block.empty() || upper(block.front()) != 'N') return block;
  const auto end = block.find_first_not_of("0123456789", 1);
  return end == std::string_view::npos ? std::string_view() : trim(block.substr(end));
}

/// These print or open what is printed on: nothing of them stays in force.
bool is_printing(std::string_view block) {
  const std::string_view bare = without_number(block);
  return bare.starts_with("DPRNT") || bare.starts_with("BPRNT") || bare.starts_with("POPEN") ||
         bare.starts_with("PCLOS");
}

/// G54.1 is 541; -1: no code.
int tenths(std::string_view value) {
  double number = 0;
  const auto read = std::from_chars(value.data(), value.data() + value.size(), number);
  if (read.ec != std::errc{} || number < 0 || number > 999) return -1;
  return static_cast<int>(std::lround(number * 10));
}

interpreter::TextForm text_form(std::string_view control) {
  const auto dialect = interpreter::find_dialect(control);
  return dialect ? (*dialect)->text : interpreter::TextForm{};
}

}  // namespace

ModalScan::ModalScan(std::string_view control) : text_(text_form(control)) {}

/// Words at depth 0: a letter and everything up to the next one. Comments are left out.
ModalScan::Block ModalScan::read(std::string_view text) {
  Block block;
  int depth = 0;
  bool is_comment = false;
  for (const char c : text) {
    if (is_comment) {
      is_comment = c != ')';
    } else if (c == '(') {
      is_comment = true;
    } else if (c == ';') {
      break;
    } else if (depth == 0 && is_letter(c)) {
      block.push_back({upper(c), {}, true});
    } else if (c != ' ' && c != '\t' && c != '\r' && !block.empty()) {
      if (c == '[') ++depth;
      if (c == ']') --depth;
      block.back().value += upper(c);
      block.back().is_number = block.back().is_number && is_of_number(c);
    }
  }
  return block;
}

const ModalCode* ModalScan::code_of(const Word& word) const {
  static constexpr ModalCode kOtherMotion{0, ModalGroup::Motion};
  if (word.letter != 'G' || !word.is_number) return nullptr;
  const int code = tenths(word.value);
  if (std::ranges::find(text_.motion_codes, code) != text_.motion_codes.end()) return &kOtherMotion;
  const auto* found = find_modal_code(code);
  const bool is_diameter = found != nullptr && found->group == ModalGroup::Diameter;
  return is_diameter && !text_.has_diameter_codes ? nullptr : found;
}

void ModalScan::set(ModalGroup group, std::string words, bool can_be_sent) {
  in_force_.insert_or_assign(
      group, ModalWord{.words = std::move(words), .line = line_, .can_be_sent = can_be_sent});
}

/// What no word carries: calls, jumps, variables. The first ones are enough to show.
void ModalScan::name_unknown(std::string_view text) {
  if (unknown_.size() >= kMaxUnknown) return;
  unknown_.push_back({.words = std::string(trim(text)), .line = line_, .can_be_sent = false});
}

void ModalScan::skip(std::string_view text) {
  ++line_;
  if (text_.kind == TextKind::PlainLanguage) return skip_plain_language(text);
  const Block block = read(text);
  if (text_.kind == TextKind::Events) return skip_event(text, block);
  bool is_computed = false;
  for (const Word& word : block) {
    const int code = word.is_number ? tenths(word.value) : -1;
    const bool is_call = (word.letter == 'M' && (code == 980 || code == 1980)) ||
                         (word.letter == 'G' && (code == 650 || code == 100));
    is_computed = is_computed || is_call || !word.is_number || word.value.empty();
  }
  // `#100=5`, IF, WHILE, GOTO, CALL and O words have words that are no numbers, or a `#` or `=`.
  const std::string_view bare = trim(text.substr(0, text.find_first_of("(;")));
  if (bare.find('%') != std::string_view::npos || is_printing(bare)) return;
  const bool is_statement = bare.find_first_of("#=[") != std::string_view::npos;
  if (is_computed || is_statement) return name_unknown(bare);
  for (const Word& word : block) skip_word(word, block, bare);
  skip_tool(block);
}

void ModalScan::skip_word(const Word& word, const Block& block, std::string_view text) {
  using enum ModalGroup;
  if (word.letter == 'F') return set(Feed, word.text());
  if (word.letter == 'S') return set(Speed, word.text());
  if (word.letter == 'M') {
    const int code = tenths(word.value) / 10;
    if (code >= 3 && code <= 5) set(Spindle, word.text());
    if (code >= 7 && code <= 9) set(Coolant, word.text());
    if (code == 48 || code == 49) set(Overrides, word.text());
    return;
  }
  const ModalCode* row = code_of(word);
  if (row == nullptr) return;
  if (row->group == Motion) {
    drop(Cycle);
    is_moving_ = word.value.find_first_not_of("0.") != std::string::npos;
  }
  std::string words =
      row->resend == Resend::Block ? std::string(without_number(text)) : word.text();
  for (const Word& other : block) {
    if (row->resend == Resend::Word && row->with.find(other.letter) != std::string_view::npos) {
      words += " " + other.text();
    }
  }
  set(row->group, std::move(words), row->resend != Resend::Never);
}

/// A T that no M6 followed is the next tool, or on a lathe the tool.
void ModalScan::skip_tool(const Block& block) {
  const auto is_change = [](const Word& word) {
    return word.letter == 'M' && tenths(word.value) == 60;
  };
  const auto tool = std::ranges::find(block, 'T', &Word::letter);
  if (tool != block.end()) set(ModalGroup::NextTool, tool->text());
  if (std::ranges::none_of(block, is_change)) return;
  const auto next = in_force_.find(ModalGroup::NextTool);
  set(ModalGroup::Tool, next == in_force_.end() ? "M6" : next->second.words + " M6");
  drop(ModalGroup::NextTool);
}

/// ProtoTRAK: what comes before the first event is the header; events carry F, T and TC,
/// and begin where the one before ended.
void ModalScan::skip_event(std::string_view text, const Block& block) {
  const bool is_event = std::ranges::any_of(
      block, [](const Word& word) { return word.letter == 'G' && tenths(word.value) >= 1000; });
  has_events_ = has_events_ || is_event;
  const std::string_view bare = trim(text);
  if (!has_events_) {
    if (block.empty() || bare.starts_with('%')) return;
    const auto before = in_force_.find(ModalGroup::Header);
    set(ModalGroup::Header, before == in_force_.end()
                                ? std::string(bare)
                                : before->second.words + "\n" + std::string(bare));
    return;
  }
  for (const Word& word : block) {
    if (word.letter == 'F') set(ModalGroup::Feed, word.text(), false);
    if (word.letter == 'T' && word.is_number && !word.value.empty()) {
      set(ModalGroup::Tool, word.text(), false);
    }
    if (word.letter == 'C' && &word != block.data() && (&word)[-1].letter == 'T') {
      set(ModalGroup::EventOffset, "T" + word.text(), false);
    }
  }
  if (is_event)
    set(ModalGroup::EventBegin, "the end of the event, where the next one begins", false);
}

/// A TNC's program is one from its first block to its END line: nothing of it is sent again.
void ModalScan::skip_plain_language(std::string_view text) {
  std::string_view bare = trim(text.substr(0, text.find(';')));
  const auto first = bare.find_first_not_of("0123456789 ");
  if (first == std::string_view::npos) return;
  const std::string_view words = bare.substr(first);
  if (words.starts_with("BEGIN PGM") || bare.starts_with('%')) {
    return set(ModalGroup::Header, std::string(words), false);
  }
  if (words.starts_with("TOOL CALL")) return set(ModalGroup::Tool, std::string(words), false);
  if (words.starts_with("CC") || words.starts_with("FN") || words.starts_with("CYCL DEF") ||
      words.starts_with("CALL") || words.starts_with("G")) {
    return name_unknown(words);
  }
  for (std::size_t at = 0; at < words.size();) {
    const auto end = std::min(words.find(' ', at), words.size());
    const std::string_view word = words.substr(at, end - at);
    if (word == "R0" || word == "RL" || word == "RR" || word == "R") {
      set(ModalGroup::Compensation, std::string(word), false);
    }
    if (word.size() > 1 && word[0] == 'F') set(ModalGroup::Feed, std::string(word), false);
    if (word == "M3" || word == "M4" || word == "M5" || word == "M03" || word == "M04") {
      set(ModalGroup::Spindle, std::string(word), false);
    }
    at = end + 1;
  }
}

bool ModalScan::look(std::string_view text) {
  if (text_.kind == TextKind::PlainLanguage || in_force_.empty() || ++looked_ > kMaxLooked)
    return false;
  const Block block = read(text);
  if (text_.kind == TextKind::Events) return look_event(block);
  for (const Word& word : block) look_word(word);
  const bool changes = std::ranges::any_of(
      block, [](const Word& word) { return word.letter == 'M' && tenths(word.value) == 60; });
  const bool has_tool =
      std::ranges::any_of(block, [](const Word& word) { return word.letter == 'T'; });
  if (has_tool) drop(ModalGroup::NextTool);
  if (changes || (has_tool && !in_force_.contains(ModalGroup::Tool))) drop(ModalGroup::Tool);
  const bool has_axes = std::ranges::any_of(block, [](const Word& word) {
    return std::string_view("XYZABCUVWIJKR").find(word.letter) != std::string_view::npos;
  });
  if (has_axes || (changes && in_force_.contains(ModalGroup::NextTool)))
    decide(is_feed_move(block));
  return !in_force_.empty();
}

void ModalScan::look_word(const Word& word) {
  using enum ModalGroup;
  if (word.letter == 'F') drop(Feed);
  if (word.letter == 'S') drop(Speed);
  if (word.letter == 'M' && word.is_number) {
    const int code = tenths(word.value) / 10;
    if (code >= 3 && code <= 5) drop(Spindle);
    if (code >= 7 && code <= 9) drop(Coolant);
    if (code == 48 || code == 49) drop(Overrides);
  }
  const ModalCode* row = code_of(word);
  if (row == nullptr) return;
  drop(row->group);
  if (row->group != Motion) return;
  drop(Cycle);
  is_moving_ = word.value.find_first_not_of("0.") != std::string::npos;
}

bool ModalScan::is_feed_move(const Block& block) const {
  const bool drills = in_force_.contains(ModalGroup::Cycle);
  const bool begins_cycle = std::ranges::any_of(block, [&](const Word& word) {
    const ModalCode* row = code_of(word);
    return row != nullptr && row->group == ModalGroup::Cycle && row->resend == Resend::Never;
  });
  return is_moving_ || drills || begins_cycle;
}

/// What is in force now is relied on: all by the first block with axis words, F and the spindle by
/// the first feed move.
void ModalScan::decide(bool is_feed_move) {
  for (auto word = in_force_.begin(); word != in_force_.end();) {
    const bool is_of_feed = word->first >= ModalGroup::Feed;
    if (is_of_feed ? !is_feed_move : is_axis_decided_) {
      ++word;
      continue;
    }
    relied_.push_back(word->second);
    word = in_force_.erase(word);
  }
  is_axis_decided_ = true;
}

/// The header is always needed: a program without it is read in other units.
bool ModalScan::look_event(const Block& block) {
  bool is_event = false, has_begin = false;
  for (const Word& word : block) {
    if (word.letter == 'G' && tenths(word.value) >= 1000) is_event = true;
    if (word.letter == 'B' && &word != block.data() && (&word)[-1].letter == 'X') has_begin = true;
    if (word.letter == 'F') drop(ModalGroup::Feed);
    if (word.letter == 'T' && !word.value.empty()) drop(ModalGroup::Tool);
    if (word.letter == 'C' && &word != block.data() && (&word)[-1].letter == 'T') {
      drop(ModalGroup::EventOffset);
    }
  }
  if (has_begin) drop(ModalGroup::EventBegin);
  return !is_event;
}

std::vector<ModalWord> ModalScan::relied_on() const {
  std::vector<ModalWord> words = relied_;
  for (const auto& [group, word] : in_force_) words.push_back(word);
  words.insert(words.end(), unknown_.begin(), unknown_.end());
  std::ranges::stable_sort(words, {}, &ModalWord::line);
  return words;
}

std::string words_text(const std::vector<ModalWord>& words) {
  std::string text;
  for (const auto& word : words) {
    std::string shown = word.words;
    std::ranges::replace(shown, '\n', ' ');
    text += fmt::format("{}{} (line {})", text.empty() ? "" : ", ", shown, word.line);
  }
  return text;
}

std::string head_text(const std::vector<ModalWord>& words) {
  std::string text;
  std::uint64_t line = 0;
  for (const auto& word : words) {
    // Several words of one block are sent as one block.
    const bool is_said = std::ranges::any_of(words, [&](const ModalWord& other) {
      const bool is_longer = other.words.size() > word.words.size() ||
                             (other.words.size() == word.words.size() && &other < &word);
      return other.line == word.line && is_longer &&
             other.words.find(word.words) != std::string::npos;
    });
    if (is_said) continue;
    if (!text.empty()) text += word.line == line ? " " : "\n";
    text += word.words;
    line = word.line;
  }
  return text.empty() ? text : text + "\n";
}

}  // namespace dripline::line
