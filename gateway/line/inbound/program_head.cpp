#include "gateway/line/inbound/program_head.hpp"

#include <algorithm>
#include <string>

#include "protocol/base/lines.hpp"

namespace dripline::line {

namespace {

constexpr std::string_view kBeginOfTnc = "BEGIN PGM ";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string upper(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](char c) { return upper(c); });
  return out;
}

std::string_view leading_digits(std::string_view text) {
  std::size_t size = 0;
  while (size < text.size() && is_digit(text[size])) ++size;
  return text.substr(0, size);
}

bool is_letter_and_digit(std::string_view line, std::string_view letters) {
  return line.size() >= 2 && letters.find(upper(line[0])) != std::string_view::npos &&
         is_digit(line[1]);
}

/// "PN7" of a ProtoTRAK's header `PN7 G20 ;`; empty: it is none.
std::string prototrak_name(std::string_view line) {
  if (line.size() < 3 || upper(line[0]) != 'P' || upper(line[1]) != 'N') return {};
  const auto digits = leading_digits(line.substr(2));
  const auto rest = trimmed(line.substr(2 + digits.size()));
  const bool is_header = rest.empty() || rest.front() == ';' || upper(rest.front()) == 'G';
  return digits.empty() || !is_header ? std::string() : "PN" + std::string(digits);
}

/// The name in one line of a head; empty: none.
std::string name_in(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with('%')) line = trimmed(line.substr(1));
  if (auto name = prototrak_name(line); !name.empty()) return name;
  if (is_letter_and_digit(line, "O:")) return "O" + std::string(leading_digits(line.substr(1)));
  const std::string big = upper(line);
  const auto begin = big.find(kBeginOfTnc);
  if (begin == std::string::npos) return {};
  const auto name = std::string_view(big).substr(begin + kBeginOfTnc.size());
  return std::string(name.substr(0, name.find(' ')));
}

/// Calls `look` with every comment's text until it returns true.
template <class Look>
void each_comment(std::string_view text, const Look& look) {
  for (std::size_t at = 0; (at = text.find_first_of("(;", at)) != std::string_view::npos;) {
    const std::string_view ends = text[at] == '(' ? ")\n" : "\n";
    const auto end = std::min(text.find_first_of(ends, at + 1), text.size());
    if (look(text.substr(at + 1, end - at - 1))) return;
    at = end;
  }
}

/// A number without its letter and leading zeros; other names as they are, in capitals.
std::string bare(std::string_view name) {
  std::string big = upper(trimmed(name));
  if (big.size() >= 2 && (big[0] == 'O' || big[0] == ':') && is_digit(big[1])) big.erase(0, 1);
  if (leading_digits(big).size() != big.size()) return big;
  const auto digit = big.find_first_not_of('0');
  return digit == std::string::npos ? "0" : big.substr(digit);
}

}  // namespace

bool begins_program(std::string_view line, bool is_after_percent) {
  line = trimmed(line);
  if (line.size() > 1 && line.front() == '%') return true;
  if (!name_in(line).empty()) return true;
  if (!is_after_percent || line.empty()) return false;
  return is_letter_and_digit(line, "NG") || line.front() == '(' || line.front() == '/';
}

std::string program_name(std::string_view head) {
  head = head.substr(0, kProgramHead);
  while (!head.empty()) {
    const auto end = std::min(head.find('\n'), head.size());
    const auto line = trimmed(head.substr(0, end));
    if (auto name = name_in(line); !name.empty()) return name;
    // After comments and `%` comes the name, or none does.
    if (!line.empty() && line.front() != '%' && line.front() != '(' && line.front() != ';') break;
    head.remove_prefix(std::min(end + 1, head.size()));
  }
  return {};
}

bool is_same_program(std::string_view a, std::string_view b) {
  return bare(a) == bare(b);
}

std::string program_number(std::string_view stored_name) {
  constexpr std::size_t kMaxDigits = 8;
  const std::string number = bare(stored_name.substr(0, stored_name.rfind('.')));
  const bool is_number = leading_digits(number).size() == number.size();
  return is_number && number.size() <= kMaxDigits ? number : std::string();
}

std::optional<std::string> find_trigger(std::string_view head, std::string_view key) {
  std::optional<std::string> value;
  const std::string wanted = upper(trimmed(key));
  each_comment(head.substr(0, kProgramHead), [&](std::string_view comment) {
    const auto equals = comment.find('=');
    if (upper(trimmed(comment.substr(0, equals))) != wanted) return false;
    value = equals == std::string_view::npos ? std::string()
                                             : std::string(trimmed(comment.substr(equals + 1)));
    return true;
  });
  return value;
}

}  // namespace dripline::line
