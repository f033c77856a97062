#include "clients/cli/text/terminal_text.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <random>

#include "protocol/base/utf8.hpp"

namespace dripline::cli {
namespace {

constexpr std::string_view kEndOfStyle = "\x1b[0m";

std::string_view sequence(char style) {
  constexpr std::string_view kSequences[] = {kEndOfStyle, "\x1b[1m",  "\x1b[32m",
                                             "\x1b[31m",  "\x1b[36m", "\x1b[2m"};
  const auto index = static_cast<std::size_t>(style - '0');
  return index < std::size(kSequences) ? kSequences[index] : kEndOfStyle;
}

/// A mark is this and the style's number. Should one reach a terminal, it is a string (APC) that
/// terminals ignore.
const std::string& begin_of_mark() {
  static const std::string kBegin = [] {
    std::random_device random;
    return fmt::format("\x1b_{:08x}{:08x}", random(), random());
  }();
  return kBegin;
}
constexpr std::string_view kEndOfMark = "\x1b\\";

std::string mark(Style style) {
  std::string text = begin_of_mark();
  text += static_cast<char>('0' + static_cast<int>(style));
  return text.append(kEndOfMark);
}

/// Removes the mark that begins `text`; gives its sequence, or nothing when none does.
std::string_view take_mark(std::string_view& text) {
  const std::string& begin = begin_of_mark();
  if (!text.starts_with(begin)) return {};
  const std::string_view rest = text.substr(begin.size());
  if (rest.empty() || !rest.substr(1).starts_with(kEndOfMark)) return {};
  text.remove_prefix(begin.size() + 1 + kEndOfMark.size());
  return sequence(rest.front());
}

/// A character of UTF-8, or a byte that is none.
struct Character {
  std::size_t size = 1;
  char32_t code = 0;
  bool is_lone_byte = false;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t size = utf8_length(text);
  if (size == 0) return {1, byte(0), true};
  constexpr std::array<char32_t, 5> kLeadBits{0, 0x7f, 0x1f, 0x0f, 0x07};
  char32_t code = byte(0) & kLeadBits[size];
  for (std::size_t i = 1; i < size; ++i) code = (code << 6) | (byte(i) & 0x3fU);
  return {size, code, false};
}

bool is_bidi_control(char32_t code) {
  return code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2066 && code <= 0x2069);
}

bool can_steer(const Character& of) {
  if (of.is_lone_byte) return of.code < 0xa0;
  return of.code < 0x20 || (of.code >= 0x7f && of.code < 0xa0) || is_bidi_control(of.code);
}

/// More of it may come: a carriage return, which a line end may follow, or the bytes that begin a
/// character of several.
bool is_begun(std::string_view text) {
  if (text == "\r") return true;
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0xc2 || lead > 0xf4) return false;
  const std::size_t size = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
  return text.size() < size && std::ranges::all_of(text.substr(1), [](char c) {
           return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
         });
}

std::string escape(const Character& of) {
  const auto code = static_cast<std::uint32_t>(of.code);
  return of.is_lone_byte || code < 0x20 ? fmt::format("\\x{:02x}", code)
                                        : fmt::format("\\u{:04x}", code);
}

/// Removes the first character and appends its visible form.
void append_visible(std::string& out, std::string_view& text) {
  if (const auto style = take_mark(text); !style.empty()) {
    out += style;
    return;
  }
  if (text.starts_with("\r\n")) {  // overwrites nothing
    out += "\r\n";
    text.remove_prefix(2);
    return;
  }
  const Character first = first_character(text);
  const bool is_plain = !can_steer(first) || first.code == '\n' || first.code == '\t';
  out += is_plain ? std::string(text.substr(0, first.size)) : escape(first);
  text.remove_prefix(first.size);
}

}  // namespace

std::string styled(std::string_view text, Style style, bool has_color) {
  if (!has_color || style == Style::Plain) return std::string(text);
  return mark(style) + std::string(text) + mark(Style::Plain);
}

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character first = first_character(text);
    out += can_steer(first) ? " " : text.substr(0, first.size);
    text.remove_prefix(first.size);
  }
  return out;
}

std::string_view VisibleText::take(std::string_view piece) {
  text_.clear();
  begun_ += piece;
  std::string_view rest = begun_;
  while (!rest.empty() && !is_begun(rest)) append_visible(text_, rest);
  begun_.erase(0, begun_.size() - rest.size());
  return text_;
}

std::string visible(std::string_view text) {
  std::string out;
  while (!text.empty()) append_visible(out, text);
  return out;
}

}  // namespace dripline::cli
