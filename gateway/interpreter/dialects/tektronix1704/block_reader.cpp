#include "gateway/interpreter/dialects/tektronix1704/block_reader.hpp"

#include <array>
#include <string>

namespace dripline::interpreter::tektronix1704 {
namespace {

constexpr std::uint8_t kNoAddress = 255;
constexpr char kDelete = 0x7f;

constexpr std::array<std::uint8_t, 256> address_by_character() {
  std::array<std::uint8_t, 256> table{};
  for (auto& entry : table) entry = kNoAddress;
  for (std::size_t i = 0; i < kLetters.size(); ++i) {
    table[static_cast<unsigned char>(kLetters[i])] = static_cast<std::uint8_t>(i);
  }
  return table;
}
constexpr auto kAddresses = address_by_character();

std::uint8_t address_of(char c) {
  return kAddresses[static_cast<unsigned char>(c)];
}
bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') <= 9;
}

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\0' || c == kDelete;
}

/// The number of a word, after its letter.
bool has_digits(std::string_view text) {
  for (const char c : text) {
    if (is_digit(c)) return true;
    if (!is_blank(c) && c != '+' && c != '-' && c != '.') return false;
  }
  return false;
}

/// The characters of one line, one after the other.
class LineInHand {
 public:
  LineInHand(Run& run, std::string_view line)
      : run_(run), block_(run.state.block), begin_(line.data()), end_(begin_ + line.size()) {}

  ReadOutcome read();

 private:
  const char* read_plain_word(const char* at);
  bool read_character(const char* at);
  bool begin_word(const char* at);
  bool end_word(const char* at);
  bool add(Address address, std::int32_t value, const char* at);
  bool add_sign(const char* at);
  bool add_digit(const char* at);
  bool is_fitted(Address address) const;
  bool meet_rubbish(const char* at);
  bool blame(const DiagnosticRow& fault, const char* at, std::string_view detail = {});
  void tell(const DiagnosticRow& fault, const char* at, std::string_view detail = {});
  std::uint32_t column(const char* at) const { return static_cast<std::uint32_t>(at - begin_) + 1; }

  Run& run_;
  BlockInProgress& block_;
  const char* begin_;
  const char* end_;
};

/// What is before the next block: nothing of the tape may be lost, so a block is left out
/// whole.
bool LineInHand::blame(const DiagnosticRow& fault, const char* at, std::string_view detail) {
  if (!run_.options.skips_bad_blocks) return run_.fail(fault, column(at), detail);
  block_.is_bad = true;
  tell(fault, at, detail);
  return true;
}

/// Ids end with a number below 500.
std::size_t number_of(const DiagnosticRow& fault) {
  std::size_t number = 0;
  for (const char c : fault.id.substr(3)) number = 10 * number + static_cast<std::size_t>(c - '0');
  return number;
}

/// Each fault once a block.
void LineInHand::tell(const DiagnosticRow& fault, const char* at, std::string_view detail) {
  const std::size_t number = number_of(fault);
  if (block_.faults.test(number)) return;
  block_.faults.set(number);
  run_.warn(fault, run_.origin, column(at), detail);
}

/// Z and what belongs to it are no letters of a two-axis control.
bool LineInHand::is_fitted(Address address) const {
  constexpr std::uint16_t kThirdAxis = bit(Address::Z) | bit(Address::K) | bit(Address::R);
  return run_.options.axes == kAxes || (bit(address) & kThirdAxis) == 0;
}

bool LineInHand::add(Address address, std::int32_t value, const char* at) {
  if (block_.words.has(address) && block_.words[address] != value) [[unlikely]] {
    const std::string letter(1, kLetters[static_cast<std::size_t>(address)]);
    if (address == Address::G || address == Address::M) {
      return blame(Fault::TwoDifferent, at,
                   letter + std::to_string(block_.words[address]) + " and " + letter +
                       std::to_string(value));
    }
    tell(Fault::Repeated, at, letter);
  }
  block_.words.set(address, value);
  return true;
}

/// A word without anything between its characters, followed by another or by the end: nearly all.
/// Gives `at` when it is anything else.
const char* LineInHand::read_plain_word(const char* at) {
  const std::uint8_t index = address_of(*at);
  if (index == kNoAddress) return at;
  const auto address = static_cast<Address>(index);
  const WordFormat format = kFormats[index];
  const char* next = at + 1;
  bool is_negative = false;
  if (next != end_ && (*next == '-' || *next == '+') && format.is_signed) {
    is_negative = *next == '-';
    ++next;
  }
  const char* const digits = next;
  std::int32_t value = 0;
  while (next != end_ && is_digit(*next) && next - digits < 9) value = value * 10 + (*next++ - '0');
  const auto count = next - digits;
  const bool is_whole = next == end_ || address_of(*next) != kNoAddress;
  if (!is_whole || count == 0 || count > format.digits || !is_fitted(address)) return at;
  if (!add(address, is_negative ? -value : value, at)) return nullptr;
  return next;
}

bool LineInHand::begin_word(const char* at) {
  if (!end_word(at)) return false;
  const auto address = static_cast<Address>(address_of(*at));
  if (!is_fitted(address)) return blame(Fault::Character, at, std::string(1, *at));
  block_.has_word = true;
  block_.address = address;
  block_.has_sign = block_.is_negative = block_.has_digit = block_.has_tab = false;
  block_.value = 0;
  block_.digits = 0;
  return true;
}

bool LineInHand::end_word(const char* at) {
  if (!block_.has_word) return true;
  block_.has_word = false;
  const char letter = kLetters[static_cast<std::size_t>(block_.address)];
  if (!block_.has_digit) return blame(Fault::NoDigits, at, std::string(1, letter));
  const unsigned limit = kFormats[static_cast<std::size_t>(block_.address)].digits;
  if (block_.digits > limit) {
    return blame(Fault::TooManyDigits, at,
                 std::string(1, letter) + " holds " + std::to_string(limit));
  }
  return add(block_.address, block_.is_negative ? -block_.value : block_.value, at);
}

bool LineInHand::add_sign(const char* at) {
  const bool may_stand = block_.has_word && !block_.has_digit && !block_.has_sign &&
                         kFormats[static_cast<std::size_t>(block_.address)].is_signed;
  if (!may_stand) return blame(Fault::Sign, at, std::string(1, *at));
  block_.has_sign = true;
  block_.is_negative = *at == '-';
  return true;
}

bool LineInHand::add_digit(const char* at) {
  if (!block_.has_word) return block_.is_bad || meet_rubbish(at);
  if (block_.has_tab) tell(Fault::Tape, at, "tab inside a word");
  block_.has_digit = true;
  if (block_.digits != 0 || *at != '0') {
    if (block_.digits < 9) block_.value = block_.value * 10 + (*at - '0');
    if (block_.digits < 255) ++block_.digits;
  }
  return true;
}

/// A character of no meaning ends the word before it; digits after it belong to nothing.
bool LineInHand::meet_rubbish(const char* at) {
  if (!end_word(at)) return false;
  return blame(Fault::Character, at, std::string(1, *at));
}

bool LineInHand::read_character(const char* at) {
  const char c = *at;
  if (address_of(c) != kNoAddress) return begin_word(at);
  if (is_digit(c)) return add_digit(at);
  switch (c) {
    case '+':
    case '-':
      return add_sign(at);
    case '.':
      tell(Fault::Point, at);
      return true;
    case '\t':
      block_.has_tab = true;
      return true;
    case ' ':
    case kDelete:
    case '\0':
      return true;
    case '(':
      block_.in_comment = true;
      return true;
    default:
      return meet_rubbish(at);
  }
}

ReadOutcome LineInHand::read() {
  block_.characters += static_cast<std::uint32_t>(end_ - begin_) + 1;
  for (const char* at = begin_; at != end_;) {
    if (*at == kRewindStop) return ReadOutcome::EndCode;
    if (block_.in_comment) {
      block_.in_comment = *at != ')';
      ++at;
      continue;
    }
    if (!block_.has_word) {
      const char* next = read_plain_word(at);
      if (next == nullptr) return ReadOutcome::Alarm;
      if (next != at) {
        at = next;
        continue;
      }
    }
    if (!read_character(at)) return ReadOutcome::Alarm;
    ++at;
  }
  if (block_.in_comment) {
    tell(Fault::Tape, end_, "end of block inside a comment");
    return ReadOutcome::GoesOn;
  }
  return end_word(end_) ? ReadOutcome::Block : ReadOutcome::Alarm;
}

}  // namespace

ReadOutcome read_line(Run& run, std::string_view line) {
  return LineInHand(run, line).read();
}

bool looks_like_block(std::string_view line) {
  bool has_words = false, has_other = false, in_comment = false, in_name = false;
  bool is_after_stop = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == kRewindStop) {
      is_after_stop = true;
      in_name = false;
      continue;
    }
    if (in_comment || c == '(') {
      in_comment = c != ')';
      continue;
    }
    if (is_blank(c)) continue;
    const std::uint8_t index = address_of(c);
    const bool is_word = index != kNoAddress && !in_name && has_digits(line.substr(i + 1));
    const std::uint16_t of_blocks = kEndWords | (is_after_stop ? bit(Address::N) : 0);
    if (is_word && (bit(static_cast<Address>(index)) & of_blocks) != 0) return true;
    in_name = is_letter(c) && !is_word;
    const bool is_of_number = is_digit(c) || c == '+' || c == '-' || c == '.';
    has_words |= is_word;
    has_other |= !is_word && !is_of_number;
  }
  return has_words && !has_other;
}

}  // namespace dripline::interpreter::tektronix1704
