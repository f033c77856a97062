#include "gateway/line/heads/modal_scan.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "gateway/interpreter/registry.hpp"
#include "gateway/line/heads/scan_text.hpp"

namespace dripline::line {

namespace {

using FormKind = interpreter::TextForm::Kind;

constexpr std::uint64_t kMaxLooked = 5000;
constexpr std::size_t kMaxUnknown = 8;
constexpr std::size_t kMaxAppended = 16;

/// These print or open what is printed on: nothing of them stays in force.
bool is_printing(std::string_view block) {
  const std::string_view bare = without_number(block);
  return bare.starts_with("DPRNT") || bare.starts_with("BPRNT") || bare.starts_with("POPEN") ||
         bare.starts_with("PCLOS");
}

/// G50 S2000, or G92 S2000.
template <class Block>
std::string limit_text(const Block& block) {
  std::string text;
  for (const auto& word : block) {
    const int code = word.letter == 'G' && word.is_number ? tenths(word.value) : -1;
    if (code != 500 && code != 920 && word.letter != 'S') continue;
    text += (text.empty() ? "" : " ") + word.text();
  }
  return text;
}

template <class Block>
bool has_any(const Block& block, std::string_view letters) {
  return std::ranges::any_of(block, [letters](const auto& word) {
    return letters.find(word.letter) != std::string_view::npos;
  });
}

interpreter::TextForm text_form(std::string_view control) {
  const auto dialect = interpreter::find_dialect(control);
  return dialect ? (*dialect)->text : interpreter::TextForm{};
}

}  // namespace

ModalScan::ModalScan(std::string_view control)
    : text_(text_form(control)),
      is_fanuc_(control.starts_with("fanuc")),
      is_lathe_(control == "fanuc-t"),
      is_rs274ngc_(control == "rs274ngc"),
      is_tektronix_(control == "tektronix-1704") {}

/// Codes whose meaning other words of the block decide: G50 and G92 with axes are a coordinate
/// system that begins where the machine is, with S alone a limit of the spindle; G5 and G8 of a
/// Fanuc are look-ahead, G5 of LinuxCNC moves.
std::optional<ModalCode> ModalScan::code_of(const Word& word, const Block& block) const {
  using enum ModalGroup;
  if (word.letter != 'G' || !word.is_number) return std::nullopt;
  const int code = tenths(word.value);
  if (std::ranges::find(text_.motion_codes, code) != text_.motion_codes.end())
    return ModalCode{code, Motion};
  if (text_.is_one_shot != nullptr && text_.is_one_shot(code)) return std::nullopt;
  const bool moves = has_any(block, "XYZABCUVW");
  if (code == 500 || code == 920) {
    if (moves) return ModalCode{code, Shift, Resend::Never};
    if (has_any(block, "S")) return ModalCode{code, SpeedLimit, Resend::Word, "S"};
  }
  if (is_tektronix_ && code == 940) return ModalCode{code, Shift, Resend::Never};
  // Cycles of one cut and threads, in one G-code system or the other.
  const bool is_box = code == 900 || code == 940 || (code >= 770 && code <= 790);
  if (is_lathe_ && is_box && moves) return ModalCode{code, Motion, Resend::Never};
  if (is_lathe_ && (code == 320 || code == 340)) return ModalCode{code, Motion};
  const bool is_path = code == 50 || code == 51;
  if (is_path && (moves || has_any(block, "IJ"))) return ModalCode{code, Motion, Resend::Never};
  if (code == 80 && !text_.has_diameter_codes)
    return ModalCode{code, LookAhead, moves ? Resend::Never : Resend::Block};
  const auto* found = find_modal_code(code);
  const bool is_of_lathe = found != nullptr && found->group == Diameter;
  if (found == nullptr || (is_of_lathe && !text_.has_diameter_codes)) return std::nullopt;
  return *found;
}

bool ModalScan::is_known_one_shot(int code) const {
  return text_.is_one_shot != nullptr ? text_.is_one_shot(code) : is_one_shot_code(code);
}

/// A center that is not written is where the machine was.
bool ModalScan::can_be_sent(const ModalCode& row, const Block& block) const {
  if (row.resend == Resend::Never) return false;
  const auto axes = std::ranges::count_if(block, [](const Word& word) {
    return std::string_view("XYZ").find(word.letter) != std::string_view::npos;
  });
  if (row.code == 680) return axes >= 2 && !has_any(block, "IJK");
  if (row.code == 510) return axes >= 3;
  return row.code != 431 || is_rs274ngc_;
}

/// Codes that set one axis after the other: all their blocks together are what is in force.
void ModalScan::append(ModalGroup group, std::string words) {
  const auto before = in_force_.find(group);
  if (before == in_force_.end()) {
    appended_[group] = 1;
    return set(group, std::move(words));
  }
  const bool fits = ++appended_[group] <= kMaxAppended;
  set(group, fits ? before->second.words + "\n" + words : before->second.words, fits);
}

void ModalScan::set(ModalGroup group, std::string words, bool can_be_sent) {
  in_force_.insert_or_assign(
      group, ModalWord{.words = std::move(words), .line = line_, .can_be_sent = can_be_sent});
}

/// What no word carries: calls, jumps, variables. The first ones are enough to show.
void ModalScan::name_unknown(std::string_view text) {
  if (unknown_.size() >= kMaxUnknown) return;
  unknown_.push_back(
      {.words = std::string(without_blanks(text)), .line = line_, .can_be_sent = false});
}

void ModalScan::skip(std::string_view text) {
  ++line_;
  if (text_.kind == FormKind::PlainLanguage) return skip_plain_language(text);
  const Block block = scan_block(text);
  if (text_.kind == FormKind::Events) return skip_event(text, block);
  bool is_computed = false;
  for (const Word& word : block) {
    const int code = word.is_number ? tenths(word.value) : -1;
    const bool is_call = (word.letter == 'M' && (code == 980 || code == 1980)) ||
                         (word.letter == 'G' && (code == 650 || code == 100));
    is_computed = is_computed || is_call || !word.is_number || word.value.empty();
  }
  // `#100=5`, IF, WHILE, GOTO, CALL and O words have words that are no numbers, or a `#` or `=`.
  const std::string_view bare = without_blanks(text.substr(0, text.find_first_of("(;")));
  if (bare.find('%') != std::string_view::npos || is_printing(bare)) return;
  const bool is_statement = bare.find_first_of("#=[") != std::string_view::npos ||
                            without_number(bare).starts_with('/');  // the panel decides on it
  if (is_computed || is_statement) return name_unknown(bare);
  for (const Word& word : block) skip_word(word, block, bare);
  skip_tool(block);
  skip_length(block);
}

void ModalScan::skip_word(const Word& word, const Block& block, std::string_view text) {
  using enum ModalGroup;
  if (word.letter == 'F') return set(Feed, word.text());
  if (word.letter == 'M') return skip_function(word, block);
  if (word.letter == 'S') {
    const bool is_limit = std::ranges::any_of(block, [&](const Word& other) {
      return other.letter == 'G' && (tenths(other.value) == 500 || tenths(other.value) == 920);
    });
    return set(is_limit ? SpeedLimit : Speed, is_limit ? limit_text(block) : word.text());
  }
  if (word.letter != 'G') return;
  const auto row = code_of(word, block);
  if (!row) {
    if (!is_known_one_shot(tenths(word.value))) name_unknown(without_number(text));
    return;
  }
  if (row->group == SpeedLimit) return;  // with its S
  if (row->group == Motion) {
    drop(Cycle);
    drop(RigidTapping);
    is_moving_ = word.value.find_first_not_of("0.") != std::string::npos;
  }
  if (row->code == 800) drop(RigidTapping);
  std::string words =
      row->resend == Resend::Block ? std::string(without_number(text)) : word.text();
  for (const Word& other : block) {
    if (row->resend == Resend::Word && row->with.find(other.letter) != std::string_view::npos) {
      words += " " + other.text();
    }
  }
  if (row->group == LocalSystem || row->group == Mirror) return append(row->group, words);
  set(row->group, std::move(words), can_be_sent(*row, block));
}

/// M functions that are known to stay in force.
void ModalScan::skip_function(const Word& word, const Block& block) {
  using enum ModalGroup;
  const int code = tenths(word.value) / 10;
  const auto speed = std::ranges::find(block, 'S', &Word::letter);
  if (code >= 3 && code <= 5) set(Spindle, word.text());
  if (code == 7) set(Mist, word.text());
  if (code == 8 || code == 9) set(Coolant, word.text());
  if (code == 9) drop(Mist);
  if (code == 48 || code == 49) set(Overrides, word.text());
  if (code == 29 && is_fanuc_) {
    set(RigidTapping, speed == block.end() ? word.text() : word.text() + " " + speed->text(),
        false);
  }
  if (!is_rs274ngc_) return;
  if ((code >= 50 && code <= 53) || (code >= 70 && code <= 73)) name_unknown(word.text());
  const auto tool = std::ranges::find(block, 'Q', &Word::letter);
  if (code == 61 && tool != block.end()) set(Tool, word.text() + " " + tool->text(), false);
}

/// H alone is another length where one is in force.
void ModalScan::skip_length(const Block& block) {
  const auto number = std::ranges::find(block, 'H', &Word::letter);
  const auto length = in_force_.find(ModalGroup::Length);
  if (number == block.end() || length == in_force_.end() || length->second.line == line_) return;
  set(ModalGroup::Length, length->second.words + " " + number->text(), false);
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

bool ModalScan::look(std::string_view text) {
  if (text_.kind == FormKind::PlainLanguage || in_force_.empty() || ++looked_ > kMaxLooked)
    return false;
  const Block block = scan_block(text);
  if (text_.kind == FormKind::Events) return look_event(block);
  for (const Word& word : block) look_word(word, block);
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
    decide(has_axes && is_feed_move(block));
  return !in_force_.empty();
}

void ModalScan::look_word(const Word& word, const Block& block) {
  using enum ModalGroup;
  if (word.letter == 'F') drop(Feed);
  if (word.letter == 'M' && word.is_number) look_function(tenths(word.value) / 10);
  const auto row = code_of(word, block);
  const bool is_limit = std::ranges::any_of(block, [&](const Word& other) {
    const auto code = code_of(other, block);
    return code && code->group == SpeedLimit;
  });
  if (word.letter == 'S') drop(is_limit ? SpeedLimit : Speed);
  if (!row) return;
  // One axis more is no new beginning of these.
  if (row->group != LocalSystem && row->group != Mirror) drop(row->group);
  if (row->group != Motion) return;
  drop(Cycle);
  is_moving_ = word.value.find_first_not_of("0.") != std::string::npos;
}

void ModalScan::look_function(int code) {
  using enum ModalGroup;
  if (code >= 3 && code <= 5) drop(Spindle);
  if (code == 7 || code == 9) drop(Mist);
  if (code == 8 || code == 9) drop(Coolant);
  if (code == 48 || code == 49) drop(Overrides);
  if (code == 29) drop(RigidTapping);
}

bool ModalScan::is_feed_move(const Block& block) const {
  const bool drills = in_force_.contains(ModalGroup::Cycle);
  const bool begins_cycle = std::ranges::any_of(block, [&](const Word& word) {
    const auto row = code_of(word, block);
    return row && row->group == ModalGroup::Cycle && row->resend == Resend::Never;
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
