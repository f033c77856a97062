#include "clients/tools/comparison/outside_inputs.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <set>

#include "clients/tools/comparison/line_stream.hpp"
#include "clients/tools/comparison/normal_form.hpp"

namespace dripline::comparison {
namespace {

/// After one of these a block is no longer executed exactly once, in the order of the text.
constexpr std::array<std::string_view, 10> kFlow{"GOTO",  "IF",  "WHILE", "LBL", "CALL",
                                                 "GOSUB", "G65", "G66",   "M98", "G98L"};
/// Variables set by a program; more are not remembered, and then named as coming from outside.
constexpr std::size_t kMaxSet = 10'000;

/// Reads the normal forms of a program's lines in order.
class VariableScan {
 public:
  explicit VariableScan(const LexicalRules& rules) : rules_(rules) {}

  /// The name of the variable from outside that the line reads; empty: none.
  std::string read(std::string_view line) {
    const bool is_flow = std::ranges::any_of(
        kFlow, [&](std::string_view word) { return line.find(word) != std::string_view::npos; });
    const bool is_head = !has_begun_ && is_program_number(line);
    has_begun_ = has_begun_ || (!line.empty() && line.front() != '%');
    if (is_flow || (line.starts_with('O') && !is_head)) has_flow_ = true;
    std::string name, target;
    for (std::size_t at = 0; at < line.size(); ++at) {
      if (line[at] != rules_.variable || !is_variable(line, at)) continue;
      const std::size_t end = name_end(line, at);
      const std::string found(line.substr(at, end - at));
      const bool is_plain = end > at + 1 && found.find_first_of("[#", 1) == std::string::npos;
      const bool is_set_here = is_plain && is_target(line, at, end);
      if (is_set_here) {
        target = found;
      } else if (!is_plain || !set_.contains(found)) {
        return found;
      }
      at = end - 1;
    }
    if (!target.empty() && !has_flow_ && set_.size() < kMaxSet) set_.insert(target);
    return {};
  }

 private:
  /// O0100 at the head; O100 SUB begins a subprogram.
  static bool is_program_number(std::string_view line) {
    return line.size() > 1 && line[0] == 'O' &&
           std::all_of(line.begin() + 1, line.end(), is_decimal_digit);
  }

  /// P of a Centurion is a word too: a variable is in an expression, after another letter, or set.
  bool is_variable(std::string_view line, std::size_t at) const {
    if (rules_.variable == '#') return true;
    const std::size_t next = at + (has_byte_sign(line, at) ? 2 : 1);
    if (next >= line.size()) return false;
    if (!is_decimal_digit(line[next])) return rules_.variable == 'P' && line[next] == '[';
    if (rules_.variable == 'Q') return true;
    const std::size_t end = name_end(line, at);
    if (end < line.size() && line[end] == '=') return true;
    if (at == 0) return false;
    const char before = line[at - 1];
    return !is_decimal_digit(before) && before != '.' && before != ']' && before != ')';
  }

  /// PB7 of a Centurion is a part of P7.
  bool has_byte_sign(std::string_view line, std::size_t at) const {
    return rules_.variable == 'P' && at + 1 < line.size() && line[at + 1] == 'B';
  }

  /// #100, #<name>, Q12, P7, PB7; of what is computed only the sign and the bracket.
  std::size_t name_end(std::string_view line, std::size_t at) const {
    std::size_t end = at + (has_byte_sign(line, at) ? 2 : 1);
    const std::size_t begin = end;
    if (end < line.size() && line[end] == '<') {
      const std::size_t close = line.find('>', end);
      return close == std::string_view::npos ? line.size() : close + 1;
    }
    while (end < line.size() && is_decimal_digit(line[end])) ++end;
    if (end == begin && end < line.size()) ++end;
    return end;
  }

  /// `#1=`, `FN0:Q1=`, `D00Q1P01`: the first variable of the line that is followed by a value.
  static bool is_target(std::string_view line, std::size_t at, std::size_t end) {
    if (end < line.size() && line[end] == '=') return true;
    return at >= 2 && is_decimal_digit(line[at - 1]) && is_digit_word(line.substr(0, at), 'D') &&
           end < line.size() && line[end] == 'P';
  }
  static bool is_digit_word(std::string_view text, char letter) {
    std::size_t at = text.size();
    while (at > 0 && is_decimal_digit(text[at - 1])) --at;
    return at > 0 && at < text.size() && text[at - 1] == letter &&
           (at == 1 || !is_capital(text[at - 2]));
  }

  const LexicalRules& rules_;
  std::set<std::string> set_;
  bool has_begun_ = false;
  bool has_flow_ = false;
};

/// Most programs have none, and are passed at the speed of a search for one character.
bool has_character(interpreter::ProgramSource& source, interpreter::ProgramIndex program,
                   char capital) {
  const char both[]{capital, static_cast<char>(capital | 0x20), 0};
  for (std::uint64_t offset = 0;;) {
    const auto window = source.fetch(program, offset, interpreter::ProgramSource::kMaxWindow);
    for (const char* c = both; *c != 0; ++c) {
      if (std::memchr(window.text.data(), *c, window.text.size()) != nullptr) return true;
    }
    if (window.reaches_end || window.text.empty()) return false;
    offset += window.text.size();
  }
}

/// `/` at the beginning of a block, or after its number.
bool is_skipped(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string_view::npos) return false;
  line.remove_prefix(at);
  if (line.front() == 'N' || line.front() == 'n')
    line.remove_prefix(std::min(line.find_first_not_of("0123456789 \t", 1), line.size()));
  return line.starts_with('/');
}

using Kind = OutsideInput::Kind;

std::optional<OutsideInput> find_variable(const LexicalRules& rules,
                                          interpreter::ProgramSource& source,
                                          interpreter::ProgramIndex program) {
  if (rules.variable == 0 || !has_character(source, program, rules.variable)) return std::nullopt;
  VariableScan scan(rules);
  LineStream lines(source, program);
  std::string normal;
  for (TextLine line; lines.next(line);) {
    normal.clear();
    append_normal(line.text, rules, {}, normal);
    if (auto name = scan.read(normal); !name.empty())
      return OutsideInput{Kind::Variable, std::move(name), {line.number, line.offset, program}};
  }
  return std::nullopt;
}

std::optional<OutsideInput> find_skip(interpreter::ProgramSource& source,
                                      interpreter::ProgramIndex program) {
  if (!has_character(source, program, '/')) return std::nullopt;
  LineStream lines(source, program);
  for (TextLine line; lines.next(line);) {
    if (is_skipped(line.text))
      return OutsideInput{Kind::BlockSkip, {}, {line.number, line.offset, program}};
  }
  return std::nullopt;
}

}  // namespace

std::vector<OutsideInput> find_outside_inputs(const interpreter::Dialect& dialect,
                                              interpreter::ProgramSource& source,
                                              interpreter::ProgramIndex programs) {
  std::optional<OutsideInput> variable, skip;
  for (interpreter::ProgramIndex program = 0; program < programs; ++program) {
    if (!variable) variable = find_variable(lexical_rules(dialect.name), source, program);
    if (!skip) skip = find_skip(source, program);
  }
  std::vector<OutsideInput> found;
  if (variable) found.push_back(*std::move(variable));
  if (skip) found.push_back(*std::move(skip));
  return found;
}

}  // namespace dripline::comparison
