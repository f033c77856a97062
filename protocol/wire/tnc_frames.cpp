#include "protocol/wire/tnc_frames.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "protocol/wire/impl/discipline_base.hpp"

namespace dripline::wire {

namespace {

constexpr std::size_t kMaxText = kMaxTncLine + 3;  // CR LF and the blank before ETB

char check_of(char begin, std::string_view text, char etb) {
  char check = static_cast<char>(begin ^ etb);
  for (const char c : text) check = static_cast<char>(check ^ c);
  return check;
}

void strip_line_end(std::string& text) {
  while (!text.empty() && (text.back() == '\r' || text.back() == '\n')) text.pop_back();
}

/// The blank that a sender puts before ETB to keep the check character printable.
void strip_filler(std::string& text, char check, bool is_used) {
  if (text.empty() || text.back() != ' ') return;
  const bool is_after_line_end = text.size() > 1 && text[text.size() - 2] == '\n';
  if (is_after_line_end || (is_used && (check ^ ' ') < ' ')) text.pop_back();
}

}  // namespace

std::string make_tnc_block(char begin, std::string_view text, const HeidenhainSettings& tnc) {
  std::string inner(text);
  if (tnc.line_end_in_block && begin == tnc.stx) inner += "\r\n";
  if (tnc.bcc_is_printable && check_of(begin, inner, tnc.etb) < ' ') inner += ' ';
  const char check = check_of(begin, inner, tnc.etb);
  return begin + inner + tnc.etb + check;
}

void TncFrameReader::begin(char c) {
  stage_ = Stage::Text;
  is_heading_ = c == tnc_.soh;
  broken_ = {};
  text_.clear();
  check_ = c;
}

std::optional<TncFrame> TncFrameReader::read(std::uint8_t character) {
  const char c = static_cast<char>(character & 0x7F);
  if (stage_ == Stage::Check) return finish(c);
  // A start inside a block: the end of that block was lost.
  if (c == tnc_.soh || c == tnc_.stx) {
    begin(c);
    return std::nullopt;
  }
  if (stage_ == Stage::Between) return read_between(c);
  check_ = static_cast<char>(check_ ^ c);
  if (c == tnc_.etb) {
    stage_ = Stage::Check;
  } else if (text_.size() >= kMaxText) {
    broken_ = "longer than a block can be";
  } else {
    text_ += c;
  }
  return std::nullopt;
}

std::optional<TncFrame> TncFrameReader::read_between(char c) {
  using enum TncFrame::Kind;
  if (c == tnc_.etb) {  // its start was lost
    begin(tnc_.stx);
    broken_ = "without a beginning";
    stage_ = Stage::Check;
    return std::nullopt;
  }
  if (c == tnc_.ack) return TncFrame{Ack, {}};
  if (c == tnc_.nak) return TncFrame{Nak, {}};
  if (c == tnc_.etx) return TncFrame{Etx, {}};
  if (c == tnc_.eot) return TncFrame{Eot, {}};
  if (c == 0 || c == kDc1 || c == kDc3) return std::nullopt;
  return TncFrame{Noise, {}};
}

std::optional<TncFrame> TncFrameReader::finish(char check) {
  using enum TncFrame::Kind;
  stage_ = Stage::Between;
  if (broken_.empty() && check != check_) broken_ = "with a wrong check character";
  strip_filler(text_, check, tnc_.bcc_is_printable);
  strip_line_end(text_);
  const auto is_control = [](char c) { return c < ' ' || c == 0x7F; };
  if (broken_.empty() && std::ranges::any_of(text_, is_control)) {
    broken_ = "with a control character";
  }
  if (!broken_.empty()) return TncFrame{Broken, std::string(broken_)};
  return TncFrame{is_heading_ ? Heading : Block, text_};
}

std::optional<TncFrame> TncFrameReader::fault() {
  if (stage_ == Stage::Between) return TncFrame{TncFrame::Kind::Noise, {}};
  if (broken_.empty()) broken_ = "with a character that the line spoiled";
  // The damaged one may have been ETB: silence or the next start ends the frame then.
  return stage_ == Stage::Check ? finish(0) : std::nullopt;
}

std::optional<TncFrame> TncFrameReader::silence() {
  if (stage_ == Stage::Between) return std::nullopt;
  stage_ = Stage::Between;
  return TncFrame{TncFrame::Kind::Broken, "without an end"};
}

namespace {

constexpr std::size_t kMaxNumber = 8;  // digits of a program number

std::string_view next_word(std::string_view& rest) {
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  const auto word = rest.substr(0, rest.find(' '));
  rest.remove_prefix(word.size());
  return word;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

/// "%7" or "%7G71": the digits.
std::string iso_program(std::string_view word) {
  const auto digits = word.substr(1, word.find_first_not_of("0123456789", 1) - 1);
  return digits.size() <= kMaxNumber ? std::string(digits) : std::string();
}

}  // namespace

TncLine read_tnc_line(std::string_view line) {
  TncLine read;
  auto rest = line;
  auto word = next_word(rest);
  if (word.starts_with('%') && word.size() > 1) {
    read.program = iso_program(word);
    if (!read.program.empty()) read.kind = TncLineKind::Begin;
    return read;
  }
  if (word == "N9999" || word == "N99999999") {
    word = next_word(rest);
    if (word.starts_with('%') && word.size() > 1) read.program = iso_program(word);
    if (!read.program.empty()) read.kind = TncLineKind::End;
    return read;
  }
  if (unsigned number = 0; is_digits(word)) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc{}) read.number = number;
  }
  if (!read.number) return read;
  word = next_word(rest);
  if ((word != "BEGIN" && word != "END") || next_word(rest) != "PGM") return read;
  const auto program = next_word(rest);
  if (!is_digits(program) || program.size() > kMaxNumber) return read;
  read.kind = word == "BEGIN" ? TncLineKind::Begin : TncLineKind::End;
  read.program = program;
  return read;
}

bool is_numbered(std::string_view line) {
  if (line.starts_with('N')) line.remove_prefix(1);
  return !line.empty() && line.front() >= '0' && line.front() <= '9';
}

}  // namespace dripline::wire
