#include "server/mtconnect/xml_text.hpp"

#include <fmt/format.h>
#include <array>

#include "protocol/base/decimal.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::mtconnect {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// The entity of an ASCII character; empty: itself.
std::string_view entity_of(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\t':
      return "&#9;";
    case '\n':
      return "&#10;";
    case '\r':
      return "&#13;";
    default:
      return c >= ' ' ? std::string_view() : kReplacement;
  }
}

/// XML has no U+FFFE and no U+FFFF.
bool is_noncharacter(std::string_view character) {
  return character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
}

void append_digits(std::string& text, unsigned value, unsigned count) {
  std::array<char, 8> digits{};
  for (unsigned i = count; i > 0; --i, value /= 10)
    digits[i - 1] = static_cast<char>('0' + value % 10);
  text.append(digits.data(), count);
}

}  // namespace

void append_escaped(std::string& xml, std::string_view text) {
  while (!text.empty()) {
    const bool is_ascii = static_cast<unsigned char>(text.front()) < 0x80;
    const std::size_t length = is_ascii ? 1 : utf8_length(text);
    const std::string_view character = text.substr(0, length);
    if (is_ascii) {
      const std::string_view entity = entity_of(text.front());
      xml += entity.empty() ? character : entity;
    } else {
      xml += length == 0 || is_noncharacter(character) ? kReplacement : character;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
}

std::string escaped(std::string_view text) {
  std::string xml;
  append_escaped(xml, text);
  return xml;
}

void append_attribute(std::string& xml, std::string_view name, std::string_view value) {
  xml += ' ';
  xml += name;
  xml += "=\"";
  append_escaped(xml, value);
  xml += '"';
}

void append_attribute(std::string& xml, std::string_view name, std::uint64_t value) {
  append_attribute(xml, name, fmt::format_int(value).c_str());
}

void append_time(std::string& xml, UtcTime time) {
  using namespace std::chrono;
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  append_digits(xml, static_cast<unsigned>(static_cast<int>(date.year())), 4);
  xml += '-';
  append_digits(xml, static_cast<unsigned>(date.month()), 2);
  xml += '-';
  append_digits(xml, static_cast<unsigned>(date.day()), 2);
  xml += 'T';
  append_digits(xml, static_cast<unsigned>(clock.hours().count()), 2);
  xml += ':';
  append_digits(xml, static_cast<unsigned>(clock.minutes().count()), 2);
  xml += ':';
  append_digits(xml, static_cast<unsigned>(clock.seconds().count()), 2);
  xml += '.';
  append_digits(xml, static_cast<unsigned>(clock.subseconds().count()), 6);
  xml += 'Z';
}

std::string number_text(double value) {
  return decimal_text(value, 4);
}

}  // namespace dripline::mtconnect
