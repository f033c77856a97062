#include "clients/tools/comparison/normal_form.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dripline::comparison {
namespace {

constexpr std::array kRules{LexicalRules{.control = "centurion",
                                         .has_parentheses = true,
                                         .has_numbers = true,
                                         .point_counts = true,
                                         .has_block_numbers = true,
                                         .variable = 'P'},
                            LexicalRules{.control = "fanuc",
                                         .has_parentheses = true,
                                         .has_numbers = true,
                                         .point_counts = true,
                                         .has_block_numbers = true,
                                         .variable = '#'},
                            LexicalRules{.control = "fanuc-t",
                                         .has_parentheses = true,
                                         .has_numbers = true,
                                         .point_counts = true,
                                         .has_block_numbers = true,
                                         .variable = '#'},
                            LexicalRules{.control = "rs274ngc",
                                         .has_parentheses = true,
                                         .has_semicolon = true,
                                         .has_marks = true,
                                         .has_numbers = true,
                                         .has_block_numbers = true,
                                         .variable = '#'},
                            LexicalRules{.control = "tnc155",
                                         .has_numbers = true,
                                         .has_comma = true,
                                         .begins_with_number = true,
                                         .has_block_numbers = true,
                                         .variable = 'Q'},
                            LexicalRules{.control = "itnc",
                                         .has_semicolon = true,
                                         .has_numbers = true,
                                         .has_comma = true,
                                         .begins_with_number = true,
                                         .has_block_numbers = true,
                                         .variable = 'Q'},
                            LexicalRules{.control = "tektronix-1704"},
                            LexicalRules{.control = "prototrak-plus"}};
constexpr LexicalRules kUnknown{};

/// What a line with one of these holds is text, in which blanks, case and digits are significant.
constexpr std::array<std::string_view, 8> kTextMarks{"DPRNT", "BPRNT", "PRINT", "POPEN",
                                                     "PCLOS", "\"",    "<",     "INPUT"};
/// Comments that do something begin so.
constexpr std::array<std::string_view, 8> kCommentMarks{"MSG,",   "DEBUG,", "PRINT,", "LOG",
                                                        "ABORT,", "PROBE",  "PY,",    "PYRUN"};

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
bool is_blank(char c) {
  return static_cast<unsigned char>(c) <= ' ';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool contains(std::string_view text, std::string_view word) {
  return std::search(text.begin(), text.end(), word.begin(), word.end(),
                     [](char a, char b) { return upper(a) == b; }) != text.end();
}

bool begins_with_mark(std::string_view comment) {
  std::string compact;
  for (const char c : comment.substr(0, 16)) {
    if (!is_blank(c)) compact += upper(c);
  }
  return std::ranges::any_of(kCommentMarks,
                             [&](std::string_view mark) { return compact.starts_with(mark); });
}

/// Removes comments; nothing where one stays that cannot be removed.
bool without_comments(std::string_view line, const LexicalRules& rules, std::string& out) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (rules.has_semicolon && line[i] == ';')
      return !rules.has_marks || !begins_with_mark(line.substr(i + 1));
    if (!rules.has_parentheses || line[i] != '(') {
      out += line[i];
      continue;
    }
    const std::size_t end = line.find(')', i);
    if (end == std::string_view::npos) return false;
    const std::string_view comment = line.substr(i + 1, end - i - 1);
    if (comment.find('(') != std::string_view::npos) return false;
    if (rules.has_marks && begins_with_mark(comment)) return false;
    out += ' ';
    i = end;
  }
  return true;
}

/// The digits and points at `at`.
std::string_view take_number(std::string_view text, std::size_t at) {
  const std::size_t end = text.find_first_not_of(".0123456789", at);
  return text.substr(at, std::min(end, text.size()) - at);
}

void append_number(std::string_view number, const LexicalRules& rules, std::string& out) {
  const std::size_t point = number.find('.');
  std::string_view whole = number.substr(0, point);
  std::string_view decimals =
      point == std::string_view::npos ? std::string_view() : number.substr(point + 1);
  if (number == "." || decimals.find('.') != std::string_view::npos) {
    out += number;  // no number at all
    return;
  }
  while (whole.size() > 1 && whole.front() == '0') whole.remove_prefix(1);
  while (!decimals.empty() && decimals.back() == '0') decimals.remove_suffix(1);
  out += whole.empty() ? "0" : whole;
  const bool is_zero = (whole.empty() || whole == "0") && decimals.empty();  // in any unit
  const bool keeps_point = rules.point_counts && point != std::string_view::npos && !is_zero;
  if (!decimals.empty() || keeps_point) out += '.';
  out += decimals;
}

/// The length of the block's number with what follows it up to its word; 0: none.
std::size_t block_number_size(std::string_view text, const LexicalRules& rules) {
  std::size_t at = rules.has_block_numbers && !text.empty() && text.front() == 'N' ? 1 : 0;
  if (at == 0 && !rules.begins_with_number) return 0;
  const std::size_t digits = at;
  while (at < text.size() && is_decimal_digit(text[at])) ++at;
  const bool is_whole = at > digits && (at == text.size() || (text[at] != '.' && text[at] != '='));
  return is_whole ? at : 0;
}

}  // namespace

const LexicalRules& lexical_rules(std::string_view control) {
  const auto found = std::ranges::find(kRules, control, &LexicalRules::control);
  return found == kRules.end() ? kUnknown : *found;
}

void append_normal(std::string_view line, const LexicalRules& rules, NormalForm form,
                   std::string& out) {
  line = trimmed(line);
  const bool is_text =
      std::ranges::any_of(kTextMarks, [&](std::string_view mark) { return contains(line, mark); });
  std::string bare;
  if (is_text || !rules.has_numbers || !without_comments(line, rules, bare)) {
    out += line;
    return;
  }
  std::string compact;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    const char c = rules.has_comma && bare[i] == ',' ? '.' : upper(bare[i]);
    if (!is_blank(c)) {
      compact += c;
      continue;
    }
    // Two numbers stay two numbers.
    const auto next = std::find_if_not(bare.begin() + static_cast<std::ptrdiff_t>(i), bare.end(),
                                       [](char b) { return is_blank(b); });
    const auto is_of_number = [](char b) { return is_decimal_digit(b) || b == '.' || b == ','; };
    const bool splits = !compact.empty() && next != bare.end() && is_of_number(compact.back()) &&
                        is_of_number(*next);
    if (splits && compact.back() != ' ') compact += ' ';
  }
  std::string_view text = compact;
  if (!form.keeps_block_numbers) {
    text.remove_prefix(block_number_size(text, rules));
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  }
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view number = take_number(text, i);
    const bool has_value =
        i + 1 < text.size() && (is_decimal_digit(text[i + 1]) || text[i + 1] == '.');
    const bool is_sign = text[i] == '+' && i > 0 && is_capital(text[i - 1]) && has_value;
    if (!number.empty()) {
      append_number(number, rules, out);
      i += number.size();
    } else {
      if (!is_sign) out += text[i];
      ++i;
    }
  }
}

namespace {

struct Token {
  std::string_view letters, value;
  friend bool operator==(const Token&, const Token&) = default;
};

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    while (at < text.size() && is_capital(text[at])) ++at;
    const std::size_t value = at;
    while (at < text.size() && !is_capital(text[at])) ++at;
    tokens.push_back({text.substr(begin, value - begin), text.substr(value, at - value)});
  }
  return tokens;
}

bool is_plain_number(std::string_view value) {
  return !value.empty() && value.find_first_not_of("+-.0123456789") == std::string_view::npos;
}

bool is_work_offset(const Token& token) {
  constexpr std::array<std::string_view, 6> kCodes{"54", "55", "56", "57", "58", "59"};
  return token.letters == "G" &&
         std::ranges::find(kCodes, token.value.substr(0, 2)) != kCodes.end();
}

bool is_zero(std::string_view number) {
  return number.find_first_not_of("+-.0") == std::string_view::npos;
}

TextChange change_of_token(const Token& token) {
  if (token.letters == "F" || token.letters == "S") {
    const bool is_amount = is_plain_number(token.value) && !is_zero(token.value);
    return is_amount ? TextChange::FeedAndSpeed : TextChange::Other;
  }
  if (token.letters == "D" || token.letters == "H")
    return is_plain_number(token.value) ? TextChange::Offsets : TextChange::Other;
  return is_work_offset(token) ? TextChange::Offsets : TextChange::Other;
}

/// The block only sets offsets, whatever its words are.
bool sets_offsets(const std::vector<Token>& tokens) {
  return std::ranges::any_of(tokens, [](const Token& token) {
    return (token.letters == "G" && (token.value == "10" || token.value == "99")) ||
           token.letters == "TOOLDEF";
  });
}

/// The words of `a` that `b` has not.
TextChange largest_missing(const std::vector<Token>& a, std::vector<Token> b) {
  TextChange largest = TextChange::None;
  for (const Token& token : a) {
    const auto found = std::ranges::find(b, token);
    if (found != b.end()) {
      b.erase(found);
    } else {
      largest = std::max(largest, change_of_token(token));
    }
  }
  return largest;
}

}  // namespace

TextChange change_of(std::string_view before, std::string_view after) {
  if (before == after) return TextChange::None;
  const auto was = tokens_of(before), is = tokens_of(after);
  const bool both_set =
      (before.empty() || sets_offsets(was)) && (after.empty() || sets_offsets(is));
  if (both_set) return TextChange::Offsets;
  return std::max(largest_missing(was, is), largest_missing(is, was));
}

}  // namespace dripline::comparison
