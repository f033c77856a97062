#include "gateway/interpreter/dialects/fanuc/reading/program_calls.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <optional>
#include <utility>

#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/text_search.hpp"

namespace dripline::interpreter::fanuc {
namespace {

// The programs that codes call, by their place in the setup's lists.
constexpr int kFirstByG = 9010;
constexpr int kFirstByM = 9020;
constexpr int kByT = 9000;

/// A word as it is written; no variable is read.
struct WrittenWord {
  char letter = 0;
  bool is_computed = false;
  double value = 0;
  std::string_view name = {};  ///< of a program; the letter is <
};

const char* skip_brackets(const char* at, const char* end) {
  int depth = 0;
  for (; at != end; ++at) {
    if (*at == '[') ++depth;
    if (*at == ']' && --depth == 0) return at + 1;
  }
  return end;
}

/// A variable: `#100`, `#[..]`, also of a variable: `##1`.
const char* skip_variable(const char* at, const char* end) {
  while (at != end && (*at == '#' || is_blank(*at))) ++at;
  if (at != end && *at == '[') return skip_brackets(at, end);
  while (at != end && is_digit(*at)) ++at;
  return at;
}

/// The words of one block, up to output text.
class BlockWords {
 public:
  BlockWords(const char* begin, const char* end) : at_(begin), end_(end) {}

  bool next(WrittenWord& word) {
    while (at_ != end_) {
      if (*at_ == '(') {
        at_ = std::find(at_, end_, ')');
      } else if (*at_ == '[') {
        at_ = skip_brackets(at_, end_);
      } else if (*at_ == '#') {
        at_ = skip_variable(at_, end_);
      } else if (*at_ == '<') {
        if (read_name(word)) return true;
      } else if (!is_letter(*at_)) {
        ++at_;
      } else if (read(word)) {
        return true;
      }
    }
    return false;
  }

 private:
  bool read_name(WrittenWord& word) {
    const std::string_view name = take_program_name(at_);
    if (name.empty()) at_ = std::find_if_not(at_ + 1, end_, is_name_character);
    word = {'<', false, 0, name};
    return !name.empty();
  }
  /// False: the letter begins no word.
  bool read(WrittenWord& word) {
    word = {upper(*at_), false, 0, {}};
    const char* value = skip_blanks(at_ + 1);
    if (is_letter(*value)) {
      const Keyword keyword = take_keyword(at_);
      if (keyword == Keyword::Dprnt || keyword == Keyword::Bprnt) at_ = end_;
      if (keyword == Keyword::None) ++at_;
      return false;
    }
    const char* operand = *value == '-' || *value == '+' ? skip_blanks(value + 1) : value;
    if (*operand == '#' || *operand == '[') {
      word.is_computed = true;
      at_ = *operand == '#' ? skip_variable(operand, end_) : skip_brackets(operand, end_);
      return true;
    }
    NumberText number;
    const char* after = read_number<NumberRules{.skip_blanks = true}>(value, nullptr, number);
    at_ = std::clamp(after, at_ + 1, end_);
    word.value = number.value;
    return number.fault == NumberFault::None;
  }

  const char* at_;
  const char* end_;
};

/// What a block calls, gathered word by word.
class BlockCall {
 public:
  BlockCall(const ControlOptions& options, CallCollector& calls, std::uint64_t line)
      : options_(options), calls_(calls), line_(line) {}

  void take(const WrittenWord& word) {
    if (is_code_call_) return;  // its words are arguments
    if (word.letter == 'P') p_ = word;
    if (word.letter == '<') name_ = word.name;
    if (word.letter == 'L') has_l_ = true;
    if (is_macro_) return;
    if (word.letter == 'G') take_g(word);
    if (word.letter == 'M') take_m(word);
    if (word.letter == 'T' && options_.t_macro) call_code(kByT);
  }

  void finish() {
    const bool may_call = is_macro_ || is_subprogram_ || has_computed_m_;
    if (!is_code_call_ && may_call && !name_.empty()) {
      calls_.add({.name = folder() + std::string(name_), .earlier = {}, .line = line_});
      return;
    }
    if (is_code_call_ || p_.letter == 0 || !may_call) return;
    if (p_.is_computed || has_computed_m_) return add_computed();
    std::uint64_t program = static_cast<std::uint64_t>(std::clamp(p_.value, 0.0, 99'999'999.0));
    const bool takes_l = options_.call_form != CallForm::EightDigits && has_l_;
    const bool has_long_numbers = options_.program_digits == 8;
    const bool has_passes =
        is_subprogram_ && options_.call_form != CallForm::L && !takes_l && !has_long_numbers;
    if (has_passes && program > 9999) program %= 10000;
    if (program >= 1 && program <= (has_long_numbers ? 99'999'999u : 9999u))
      add(program);  // else the run alarms
  }

 private:
  void take_g(const WrittenWord& word) {
    if (word.is_computed) {
      if (!options_.g_macros.empty()) add_computed();
      return;
    }
    if (const int place = place_in(options_.g_macros, word.value); place >= 0)
      return call_code(kFirstByG + place);
    if (word.value != 65 && word.value != 66) return;
    is_macro_ = true;
    p_ = {};
  }

  void take_m(const WrittenWord& word) {
    if (word.is_computed) {
      has_computed_m_ = true;
      if (!options_.m_macros.empty()) add_computed();
      return;
    }
    if (const int place = place_in(options_.m_macros, word.value); place >= 0)
      return call_code(kFirstByM + place);
    if (word.value == 98 || word.value == 198) is_subprogram_ = true;
    if (word.value == 198) is_external_ = true;
  }

  static int place_in(const std::vector<std::int64_t>& codes, double code) {
    const auto at = std::ranges::find_if(
        codes, [code](std::int64_t each) { return static_cast<double>(each) == code; });
    return at == codes.end() ? -1 : static_cast<int>(at - codes.begin());
  }
  void call_code(int program) {
    is_code_call_ = true;
    add(static_cast<std::uint64_t>(program));
  }
  void add(std::uint64_t program) {
    calls_.add({.name = fmt::format("{}O{:04}", folder(), program), .earlier = {}, .line = line_});
  }
  std::string folder() const {
    return is_external_ && !is_code_call_ && !is_macro_ ? options_.external_folder : std::string();
  }
  void add_computed() { calls_.add({.name = {}, .earlier = {}, .line = line_}); }

  const ControlOptions& options_;
  CallCollector& calls_;
  const std::uint64_t line_;
  bool is_macro_ = false, is_subprogram_ = false, is_code_call_ = false, has_computed_m_ = false;
  bool has_l_ = false, is_external_ = false;
  WrittenWord p_;  ///< without a letter: none
  std::string_view name_;
};

void read_calls(const ControlOptions& options, const CallLines& lines, CallCollector& calls) {
  for (const char* begin = lines.begin(); begin < lines.end();) {
    const char* end = begin;
    bool in_comment = false;
    for (; end != lines.end(); ++end) {
      if (*end == '(') in_comment = true;
      if (*end == ')') in_comment = false;
      if (*end == ';' && !in_comment && options.semicolon_eob) break;
    }
    BlockCall call(options, calls, lines.number());
    BlockWords words(begin, end);
    for (WrittenWord word; words.next(word);) call.take(word);
    call.finish();
    begin = end + 1;
  }
}

Result<ProgramCalls> calls_of(const Setup& setup, bool is_lathe, ProgramSource& source,
                              ProgramIndex program) {
  const auto options = read_options(setup, is_lathe);
  if (!options) return fail(options.error());
  CallCollector calls;
  CallLines lines(source, program);
  bool has_begun = false, has_code = false;
  for (;;) {
    const auto has_line = lines.next();
    if (!has_line) return fail(has_line.error());
    if (!*has_line) break;
    const BlockHead head = read_head(lines.begin(), lines.end());
    if (head.kind == BlockHead::Kind::Empty) continue;
    if (head.kind == BlockHead::Kind::Percent) {
      if (std::exchange(has_begun, true)) break;
      continue;
    }
    has_begun = true;
    if (head.kind == BlockHead::Kind::Program) {
      // A run that has called this text leaves it at the next program.
      if (has_code && program != kMainProgram) break;
      calls.add_contained(head.name.empty() ? fmt::format("O{:04}", head.number)
                                            : std::string(head.name));
    }
    has_code = true;
    read_calls(*options, lines, calls);
  }
  return calls.take();
}

}  // namespace

Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source,
                                   ProgramIndex program) {
  return calls_of(setup, false, source, program);
}
Result<ProgramCalls> lathe_program_calls(const Setup& setup, ProgramSource& source,
                                         ProgramIndex program) {
  return calls_of(setup, true, source, program);
}

}  // namespace dripline::interpreter::fanuc
