#include "gateway/line/inbound/inbound_splitter.hpp"

#include <utility>

#include "gateway/line/inbound/program_head.hpp"
#include "gateway/line/inbound/rule_set.hpp"

namespace dripline::line {
namespace {

constexpr std::size_t kPiece = 16 * 1024;

bool is_dropped(char c) {
  return c == '\0' || c == '\x7f' || c == '\r';
}

bool is_percent(std::string_view line) {
  const auto first = line.find_first_not_of(" \t");
  return first != std::string_view::npos && line.substr(first).find_last_not_of(" \t") == 0 &&
         line[first] == '%';
}

/// "O1 ROUGH)": the comment began in text that is not here.
bool ends_comment(std::string_view line) {
  const auto bracket = line.find_first_of("()");
  return bracket != std::string_view::npos && line[bracket] == ')';
}

}  // namespace

void InboundSplitter::begin(std::string name, bool is_program) {
  name_ = std::move(name);
  if ((is_program || !name_.empty()) && !is_program_) begin_program();
}

std::vector<InboundSplitter::Item> InboundSplitter::take(std::string_view text) {
  for (const char c : text) {
    if (is_dropped(c)) continue;
    if (c == '\n') {
      end_line();
      continue;
    }
    line_ += c;
    if (line_.size() < kMaxLine) continue;
    if (!is_program_ && is_program_line(line_)) begin_program_with(line_);
    if (is_program_) {
      add_to_program(std::exchange(line_, {}));
    } else {
      add_line(std::exchange(line_, {}), true);
    }
  }
  if (is_program_) flush_program();
  return taken();
}

/// A rule may decide that such a line is printed, or begins a program; a call in it decides
/// neither.
bool InboundSplitter::is_program_line(const std::string& line) const {
  if (is_first_of_rest_ && ends_comment(line)) return false;
  const auto hit = rules_.judge(TextKind::Line, line);
  if (hit.rule != nullptr && hit.action == RuleAction::Program) return true;
  if (hit.rule != nullptr &&
      (hit.action == RuleAction::Report || hit.action == RuleAction::Ignore)) {
    return false;
  }
  return takes_any() || begins_program(line, is_after_percent_);
}

/// Another program than the one in hand. `:15` is what ISO tapes have for O15.
bool InboundSplitter::begins_next(const std::string& line) {
  if (!extracts_ || !name_.empty()) return false;
  const auto first = line.find_first_not_of(" \t");
  if (first == std::string::npos || line[first] != ':') return programs_.begins_next(line);
  std::string with_letter = line;
  with_letter[first] = 'O';
  return programs_.begins_next(with_letter);
}

/// What a complete line is depends on what came before it.
void InboundSplitter::end_line(bool is_cut) {
  const std::string line = std::exchange(line_, {});
  take_line(line, std::exchange(is_lost_, false) || is_cut);
  is_first_of_rest_ = false;
}

void InboundSplitter::take_line(const std::string& line, bool is_cut) {
  if (is_program_) {
    if (begins_next(line)) {
      end_program();
      begin_program();
      begins_next(line);
    }
    add_to_program(line + "\n");
    // The second % ends a program; a name alone in front of it is none.
    if (is_percent(line) && ++blocks_ > 1 && name_.empty()) end_program();
    if (!line.empty()) ++blocks_;
    return;
  }
  if (is_percent(line)) {
    is_after_percent_ = !std::exchange(is_printing_, false);
    return;
  }
  if (line.find_first_not_of(" \t") == std::string::npos) return;
  if (!is_program_line(line)) {
    is_printing_ = is_printing_ || std::exchange(is_after_percent_, false);
    has_rest_ = has_rest_ || takes_programs_only_;
    add_line(line, is_cut);
    return;
  }
  begin_program_with(line);
  add_to_program(line + "\n");
}

void InboundSplitter::add_line(std::string text, bool is_cut) {
  items_.push_back({.what = Item::What::Line,
                    .text = std::move(text),
                    .is_cut = is_cut,
                    .may_be_rest = is_marking_});
}

bool InboundSplitter::may_be_program() const {
  return is_program_ || takes_any() || is_after_percent_ ||
         (!line_.empty() && is_program_line(line_));
}

/// `line` is its first.
void InboundSplitter::begin_program_with(const std::string& line) {
  begin_program();
  begins_next(line);
  blocks_ = 1;
}

void InboundSplitter::begin_program() {
  is_program_ = true;
  is_marking_ = false;
  blocks_ = 0;
  programs_ = {};
  head_.clear();
  items_.push_back({.what = Item::What::ProgramBegan, .text = name_});
  if (std::exchange(is_after_percent_, false)) add_to_program("%\n");
  is_printing_ = false;
}

void InboundSplitter::add_to_program(std::string_view text) {
  if (head_.size() < kProgramHead) head_ += text.substr(0, kProgramHead - head_.size());
  piece_ += text;
  if (piece_.size() >= kPiece) flush_program();
}

void InboundSplitter::flush_program() {
  if (piece_.empty()) return;
  items_.push_back({.what = Item::What::ProgramText, .text = std::exchange(piece_, {})});
}

void InboundSplitter::end_program() {
  flush_program();
  is_program_ = false;
  name_.clear();
  items_.push_back({.what = Item::What::ProgramEnded, .text = std::exchange(head_, {})});
}

std::vector<InboundSplitter::Item> InboundSplitter::end() {
  if (!line_.empty()) end_line();
  // The line took the end character for its own; a ProtoTRAK's program is none without it.
  if (is_program_ && takes_programs_only_) add_to_program("%\n");
  if (is_program_) end_program();
  name_.clear();
  is_after_percent_ = is_printing_ = may_be_rest_ = is_first_of_rest_ = has_rest_ = false;
  is_marking_ = false;
  return taken();
}

std::vector<InboundSplitter::Item> InboundSplitter::end_silent() {
  if (!line_.empty()) end_line(true);
  return end();
}

std::vector<InboundSplitter::Item> InboundSplitter::fail() {
  // Some controls write a whole program in one line.
  if (!is_program_ && !line_.empty() && is_program_line(line_)) begin_program();
  if (is_program_) {
    is_program_ = false;
    piece_.clear();
    line_.clear();
    items_.push_back({.what = Item::What::ProgramFailed, .text = {}});
  }
  return end_silent();
}

std::vector<InboundSplitter::Item> InboundSplitter::taken() {
  return std::exchange(items_, {});
}

}  // namespace dripline::line
