#include "gateway/interpreter/dialects/centurion/reading/program_calls.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "gateway/interpreter/dialects/centurion/options.hpp"
#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr double kHighestCalled = 9999;
// The programs that custom codes call, by their place in the setup's lists.
constexpr unsigned kFirstByG = 9010;
constexpr unsigned kFirstByM = 9020;

/// A number that is written, or one that a run computes.
struct WrittenNumber {
  bool is_computed = false;
  double value = 0;
};

/// What a block calls, gathered item by item; no parameter is read.
class BlockCall {
 public:
  BlockCall(const ControlOptions& options, CallCollector& calls, const CallLines& lines)
      : options_(options), calls_(calls), line_(lines.number()), at_(lines.begin()) {}

  void read() {
    while (!is_end_of_block(*at_)) {
      if (*at_ == '(') {
        skip_past(')');
      } else if (*at_ == '[') {
        skip_brackets();
      } else if (kind_of(*at_) == CharKind::Letter) {
        read_item();
      } else {
        ++at_;
      }
    }
    // In a block with a condition the parameters before the call are operands.
    const auto& number = p_after_ ? p_after_ : p_before_;
    if (takes_p_ && number) add(*number);
  }

 private:
  void read_item() {
    const char letter = upper(*at_);
    const char* value = skip_blanks(at_ + 1);
    const CharKind kind = kind_of(*value);
    if (kind == CharKind::Digit || kind == CharKind::Sign || kind == CharKind::Point) {
      const Number number = read_number(value);
      at_ = std::max(value, at_ + 1);
      if (number.fault == NumberFault::None) take(letter, {false, number.value});
    } else if (*value == '[') {
      at_ = value;
      skip_brackets();
      take(letter, {true, 0});
    } else {
      read_keyword();
    }
  }

  void read_keyword() {
    const Keyword keyword = take_keyword(at_);
    if (keyword == Keyword::None) ++at_;
    if (keyword == Keyword::Print || keyword == Keyword::Dprnt) {
      while (!is_end_of_block(*at_)) ++at_;  // output text
    }
    if (keyword != Keyword::Call) return;
    at_ = skip_blanks(at_);
    if (!is_digit(*at_)) return add({true, 0});
    add({false, read_number(at_).value});
  }

  void take(char letter, WrittenNumber number) {
    if (letter == 'P') (takes_p_ ? p_after_ : p_before_) = number;
    if (number.is_computed) return;
    if (letter == 'G') take_code(options_.custom_g, number.value, kFirstByG);
    if (letter == 'M') take_code(options_.custom_m, number.value, kFirstByM);
    if (letter == 'M' && number.value == 6 && options_.tool_change_program != 0)
      add_custom(options_.tool_change_program);
    takes_p_ |= (letter == 'M' && number.value == 98) || (letter == 'G' && number.value == 65);
  }

  void take_code(const std::array<int, 10>& codes, double code, unsigned first) {
    for (unsigned i = 0; i < codes.size() && options_.has_custom_codes; ++i) {
      if (codes[i] != 0 && codes[i] == code) add_custom(first + i);
    }
  }

  /// Programs of the RAM directory come before all others.
  void add_custom(unsigned program) {
    calls_.add({.name = fmt::format("O{:04}", program),
                .earlier = fmt::format("RAM-O{:04}", program),
                .line = line_});
  }
  void add(WrittenNumber number) {
    if (number.is_computed) return calls_.add({.name = {}, .earlier = {}, .line = line_});
    const double program = std::round(number.value);
    if (!(program >= 1 && program <= kHighestCalled)) return;  // the run alarms
    calls_.add({.name = fmt::format("O{:04}", static_cast<unsigned>(program)),
                .earlier = {},
                .line = line_});
  }

  void skip_past(char close) {
    while (*at_ != close && !is_end_of_block(*at_)) ++at_;
    if (*at_ == close) ++at_;
  }
  void skip_brackets() {
    int depth = 0;
    for (; !is_end_of_block(*at_); ++at_) {
      if (*at_ == '[') ++depth;
      if (*at_ != ']' || --depth > 0) continue;
      ++at_;
      return;
    }
  }

  const ControlOptions& options_;
  CallCollector& calls_;
  const std::uint64_t line_;
  const char* at_;
  bool takes_p_ = false;
  std::optional<WrittenNumber> p_before_, p_after_;
};

}  // namespace

Result<ProgramCalls> program_calls(const Setup& setup, ProgramSource& source,
                                   ProgramIndex program) {
  const auto options = read_options(setup);
  if (!options) return fail(options.error());
  CallCollector calls;
  CallLines lines(source, program);
  bool has_code = false;
  for (;;) {
    const auto has_line = lines.next();
    if (!has_line) return fail(has_line.error());
    if (!*has_line) break;
    const BlockHead head = read_head(lines.begin());
    if (head.kind == BlockHead::Kind::Empty) continue;
    if (head.kind == BlockHead::Kind::Program) {
      // A run that has called this text leaves it at the next program.
      if (has_code && program != kMainProgram) break;
      calls.add_contained(fmt::format("O{:04}", head.number));
    }
    has_code = true;
    BlockCall(*options, calls, lines).read();
  }
  return calls.take();
}

}  // namespace dripline::interpreter::centurion
