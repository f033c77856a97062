#include "clients/tools/program_editing/tnc155/block_words.hpp"

#include <algorithm>
#include <array>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

namespace dripline::program_editing {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

/// Addresses of plain language; the longer of two with the same beginning comes first.
constexpr std::array<std::string_view, 72> kPlainAddresses{"DEF BLK FORM",
                                                           "REF. PLANE",
                                                           "BEGIN PGM",
                                                           "TOOL CALL",
                                                           "CYCL CALL",
                                                           "TCH PROBE",
                                                           "TOOL DEF",
                                                           "CALL LBL",
                                                           "CALL PGM",
                                                           "CYCL DEF",
                                                           "GOTO LBL",
                                                           "END PGM",
                                                           "PECKING",
                                                           "SET-UP",
                                                           "RADIUS",
                                                           "DEPTH",
                                                           "PECKG",
                                                           "DWELL",
                                                           "STOP",
                                                           "SQRT",
                                                           "IROT",
                                                           "IPR",
                                                           "IPA",
                                                           "ROT",
                                                           "RND",
                                                           "LBL",
                                                           "SIN",
                                                           "COS",
                                                           "LEN",
                                                           "DIV",
                                                           "EQU",
                                                           "REP",
                                                           "SCL",
                                                           "PGM",
                                                           "IX",
                                                           "IY",
                                                           "IZ",
                                                           "IA",
                                                           "IB",
                                                           "IC",
                                                           "IU",
                                                           "IV",
                                                           "IW",
                                                           "IF",
                                                           "FN",
                                                           "LP",
                                                           "CC",
                                                           "CP",
                                                           "CT",
                                                           "NE",
                                                           "GT",
                                                           "LT",
                                                           "PR",
                                                           "PA",
                                                           "DR",
                                                           "X",
                                                           "Y",
                                                           "Z",
                                                           "A",
                                                           "B",
                                                           "C",
                                                           "U",
                                                           "V",
                                                           "W",
                                                           "L",
                                                           "R",
                                                           "F",
                                                           "M",
                                                           "S",
                                                           "Q",
                                                           "=",
                                                           "*"};
/// Those of calculations are read where nothing else fits.
constexpr std::string_view kSigns = "+-";
constexpr std::string_view kIsoLetters = "NXYZIJKABCUVWRHTLSFMDQ%";
constexpr std::string_view kValueCharacters = "+-0123456789.,/:Q";

bool is_axis(std::string_view address) {
  return address == "IV" || (address.size() == 1 && is_axis_letter(address.front()));
}
bool begins_value(char c) {
  return (kCharacterBits[static_cast<unsigned char>(c)] & kValueBit) != 0;
}

/// Characters that can follow an address directly.
bool is_value_of(std::string_view address, std::string_view rest) {
  if (rest.empty() || begins_value(rest.front())) return true;
  if (address == "F") return rest.starts_with("MAX");
  return address == "R" && (rest.front() == 'L' || rest.front() == 'R');
}

/// The address that a word in plain language begins with; empty: none. `drop_blanks`: of addresses
/// of several words.
std::string_view plain_address(std::string_view word, bool drop_blanks) {
  for (const std::string_view address : kPlainAddresses) {
    std::string spelling(address);
    if (drop_blanks) std::erase(spelling, ' ');
    if (!word.starts_with(spelling)) continue;
    const std::string_view rest = word.substr(spelling.size());
    if (rest.starts_with(' ') || is_value_of(address, rest)) return address;
    if (address == "DEF BLK FORM" && (rest == "MIN" || rest == "MAX")) return address;
  }
  const bool is_sign = !word.empty() && kSigns.find(word.front()) != std::string_view::npos;
  return is_sign ? kSigns.substr(kSigns.find(word.front()), 1) : std::string_view{};
}

/// Takes words from left to right.
class WordCutter {
 public:
  WordCutter(std::string_view text, Form form)
      : text_(text), is_iso_(form == Form::Iso), is_probe_(text.find("G55") != text.npos) {}

  std::vector<BlockWord> cut() {
    for (std::size_t at = next_token(0); at < text_.size(); at = next_token(words_.back().end)) {
      words_.push_back(is_iso_ ? iso_word(at) : plain_word(at));
    }
    return std::move(words_);
  }

 private:
  std::size_t next_token(std::size_t at) const {
    return std::min(text_.find_first_not_of(' ', at), text_.size());
  }
  std::string_view token(std::size_t at) const {
    return text_.substr(at, text_.find(' ', at) - at);
  }

  BlockWord word(std::size_t at, std::string_view address, std::string_view value) const {
    const std::string_view last = value.empty() ? address : value;
    const auto end = static_cast<std::size_t>(last.data() - text_.data()) + last.size();
    return {address, value, at, end};
  }

  BlockWord plain_word(std::size_t at) const {
    std::string_view address = text_.substr(at, plain_address(text_.substr(at), false).size());
    if (address.empty()) address = token(at);  // MM, INCH and P of the first and the last block
    const std::size_t after = at + address.size();
    if (after < text_.size() && text_[after] != ' ') return word(at, address, token(after));
    const std::string_view next = token(next_token(after));
    if (address == "CYCL DEF" && next.ends_with(".0")) {
      return word(at, address, text_.substr(next_token(after)));
    }
    const bool is_its = address == "F" ? next == "MAX" : is_separate_value(address, next);
    return word(at, address, is_its ? next : std::string_view{});
  }
  static bool is_separate_value(std::string_view address, std::string_view next) {
    if (address == "DEF BLK FORM") return next == "MIN" || next == "MAX";
    const bool is_operator = next.size() < 2 && !next.empty() && !is_decimal_digit(next.front());
    return !next.empty() && !is_operator && next.front() != 'Q' && begins_value(next.front());
  }
  static bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

  BlockWord iso_word(std::size_t at) const {
    const std::string_view own = token(at);
    if (own.front() == 'G' || own == "*") return word(at, own, {});
    if (own.front() != 'P') return word(at, own.substr(0, 1), own.substr(1));
    const std::string_view next = token(next_token(at + own.size()));
    const bool has_axis = next.size() > 1 && is_axis_letter(next.front());
    const bool is_point = is_probe_ && own == "P03";  // its axis words are words of their own
    const bool is_its = !next.empty() && !is_point && (has_axis || begins_value(next.front()));
    return word(at, own, is_its ? next : std::string_view{});
  }

  std::string_view text_;
  bool is_iso_;
  bool is_probe_;
  std::vector<BlockWord> words_;
};

/// Without blanks, in capitals: both mean nothing.
std::string squeezed(std::string_view typed) {
  std::string text;
  for (const char c : typed) {
    if (c == ' ' || c == '\t') continue;
    text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return text;
}

TypedWord split_plain(const std::string& text) {
  std::string word = text.starts_with("BLKFORM") ? "DEF" + text : text;
  const std::string_view address = plain_address(word, true);
  std::string spelling(address);
  std::erase(spelling, ' ');
  return {std::string(address), word.substr(spelling.size())};
}

TypedWord split_iso(const std::string& text) {
  const char first = text.empty() ? '\0' : text.front();
  const auto digits = std::min(text.find_first_not_of("0123456789", 1), text.size());
  if (first == 'G' && digits > 1) {
    const std::string code = text.substr(1, digits - 1);
    return {(code.size() < 2 ? "G0" : "G") + code, text.substr(digits)};
  }
  if (first == 'P' && digits >= 3) return {text.substr(0, 3), text.substr(3)};
  if (first == 'G' || first == 'P') return {text.substr(0, 1), text.substr(1)};
  const bool is_known = first != '\0' && kIsoLetters.find(first) != std::string_view::npos;
  return is_known ? TypedWord{text.substr(0, 1), text.substr(1)} : TypedWord{};
}

bool is_one_value(const TypedWord& word, Form form) {
  std::string_view value = word.value;
  if (form == Form::Plain && word.address == "F" && value == "MAX") return true;
  if (form == Form::Plain && word.address == "R" && (value == "L" || value == "R")) return true;
  if (form == Form::Plain && word.address == "DEF BLK FORM") return true;
  const bool is_parameter = form == Form::Iso && word.address.front() == 'P';
  if (is_parameter && !value.empty() && is_axis_letter(value.front())) value.remove_prefix(1);
  if (form == Form::Iso && word.address.front() == 'G') return value.empty();
  return value.find_first_not_of(kValueCharacters) == std::string_view::npos;
}

Result<TypedWord> split(std::string_view typed, Form form) {
  const std::string text = squeezed(typed);
  TypedWord word = form == Form::Iso ? split_iso(text) : split_plain(text);
  if (!word.address.empty()) return word;
  return fail(Errc::Syntax, "\"{}\" is no word of {}", typed,
              form == Form::Iso ? "ISO" : "plain language");
}

/// The spindle axis of TOOL CALL and BLK FORM is an axis alone.
const BlockWord* spindle_axis(const std::vector<BlockWord>& words) {
  if (words.front().address != "TOOL CALL" && words.front().address != "DEF BLK FORM") return {};
  for (const BlockWord& word : words) {
    if (word.value.empty() && is_axis(word.address)) return &word;
  }
  return nullptr;
}

std::uint8_t group_of(std::string_view address) {
  int code = address.size() < 3 ? 1000 : 0;
  for (const char c : address.substr(1)) code = std::min(code * 10 + (c - '0'), 1000);
  return code > 99 ? kIllegalCode : kGroupsOfCodes[static_cast<std::size_t>(code)];
}

}  // namespace

std::vector<BlockWord> words_of(std::string_view text, Form form) {
  return WordCutter(text, form).cut();
}

Result<TypedWord> read_typed_word(std::string_view typed, Form form) {
  auto word = split(typed, form);
  if (word && !is_one_value(*word, form)) {
    return fail(Errc::Syntax, "\"{}\" is not one word: {} is followed by \"{}\"", typed,
                word->address, word->value);
  }
  return word;
}

Result<std::string> read_typed_address(std::string_view typed, Form form) {
  const auto word = split(typed, form);
  if (!word) return fail(word.error());
  if (!word->value.empty()) {
    return fail(Errc::Syntax, "\"{}\": expected an address alone, as {}", typed, word->address);
  }
  return word->address;
}

bool is_found_by(const BlockWord& word, std::string_view address) {
  static constexpr std::string_view kPlaceholders[] = {"R", "F", "M", "REP"};
  const bool is_placeholder =
      word.value.empty() &&
      std::ranges::find(kPlaceholders, word.address) != std::end(kPlaceholders);
  if (is_placeholder) return false;
  if (word.address == address) return true;
  if (address == "Q") return word.value.find('Q') != std::string_view::npos;
  return (address == "G" || address == "P") && word.address.starts_with(address) &&
         word.address.size() == 3;
}

const BlockWord* word_for(const std::vector<BlockWord>& words, const TypedWord& typed, Form form) {
  if (words.empty()) return nullptr;
  const bool is_bare = typed.value.empty();
  if (form == Form::Plain && is_bare && is_axis(typed.address)) {
    if (const BlockWord* axis = spindle_axis(words)) return axis;
  }
  const BlockWord* found = nullptr;
  const bool is_code = form == Form::Iso && typed.address.front() == 'G';
  for (const BlockWord& word : words) {
    const bool is_of_group =
        is_code && word.address.front() == 'G' && group_of(word.address) == group_of(typed.address);
    if (word.address != typed.address && !is_of_group) continue;
    if (word.value.empty() == is_bare) return &word;
    if (found == nullptr) found = &word;
  }
  return found;
}

}  // namespace dripline::program_editing
