#include "clients/cli/port/traffic_text.hpp"

#include <fmt/format.h>
#include <array>
#include <charconv>
#include <optional>

#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

constexpr std::size_t kHexWidth = 16;   ///< bytes a line
constexpr std::size_t kTextWidth = 96;  ///< bytes a line, when no block ends before
constexpr double kPause = 0.5;          ///< seconds

constexpr std::array<std::string_view, 32> kNames{
    "NUL", "SOH", "STX", "ETX", "EOT", "ENQ", "ACK", "BEL", "BS",  "HT",  "LF",
    "VT",  "FF",  "CR",  "SO",  "SI",  "DLE", "DC1", "DC2", "DC3", "DC4", "NAK",
    "SYN", "ETB", "CAN", "EM",  "SUB", "ESC", "FS",  "GS",  "RS",  "US"};

struct Kind {
  std::string_view what, sign;
  Style style;
};
constexpr std::array kKinds{
    Kind{"sent", "→", Style::Good},   Kind{"received", "←", Style::Busy},
    Kind{"fault", "!", Style::Bad},   Kind{"lines", "~", Style::Faint},
    Kind{"state", "=", Style::Plain}, Kind{"lost", "!", Style::Bad},
};

Kind kind_of(std::string_view what) {
  for (const Kind& kind : kKinds) {
    if (kind.what == what) return kind;
  }
  return {what, "·", Style::Plain};
}

std::optional<std::string> bytes_of_hex(std::string_view hex) {
  std::string bytes;
  if (hex.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    unsigned value = 0;
    const char* first = hex.data() + i;
    if (const auto read = std::from_chars(first, first + 2, value, 16); read.ptr != first + 2) {
      return std::nullopt;
    }
    bytes += static_cast<char>(value);
  }
  return bytes;
}

bool is_line_end(char c) {
  return c == '\n' || c == '\r' || c == '\0';
}

/// Characters that hold, begin or confirm.
bool is_handshake(char c) {
  constexpr std::string_view kHandshakes = "\x04\x05\x06\x11\x12\x13\x14\x15\x18";
  return kHandshakes.find(c) != std::string_view::npos;
}

std::string hex_line(std::string_view bytes) {
  std::string digits, text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    digits += fmt::format("{:02x} ", byte);
    text += byte >= 0x20 && byte < 0x7F ? c : '.';
  }
  return fmt::format("{:<{}} {}", digits, 3 * kHexWidth, text);
}

}  // namespace

std::string named_characters(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < kNames.size()) {
      text += fmt::format("<{}>", kNames[byte]);
    } else if (byte == 0x7F) {
      text += "<DEL>";
    } else if (byte > 0x7F) {
      text += fmt::format("<{:02X}>", byte);
    } else {
      text += c;
    }
  }
  return text;
}

std::string TrafficText::line(std::string_view time, std::string_view what,
                              std::string_view text) const {
  const Kind kind = kind_of(what);
  return fmt::format("{}  {}  {}\n", styled(clock_text(time), Style::Faint, look_.has_color),
                     styled(kind.sign, kind.style, look_.has_color),
                     styled(text, kind.style, look_.has_color));
}

std::string TrafficText::end(Begun& begun) const {
  if (begun.bytes.empty()) return {};
  std::string out = line(begun.first_time, begun.what,
                         look_.is_hex ? hex_line(begun.bytes) : named_characters(begun.bytes));
  begun.bytes.clear();
  return out;
}

std::string TrafficText::flush() {
  const bool is_sent_first = sent_.first_time <= received_.first_time;
  std::string out = end(is_sent_first ? sent_ : received_);
  out += end(is_sent_first ? received_ : sent_);
  return out;
}

/// `next` would begin a line of its own.
bool TrafficText::is_full(const Begun& begun, char next) const {
  if (begun.bytes.empty()) return false;
  if (look_.is_hex) return begun.bytes.size() >= kHexWidth;
  return begun.bytes.size() >= kTextWidth || is_handshake(begun.bytes.back()) ||
         (is_line_end(begun.bytes.back()) && !is_line_end(next));
}

std::string TrafficText::append(Begun& begun, std::string_view bytes,
                                const client::Traffic& traffic) const {
  std::string out;
  if (seconds_between(begun.last_time, traffic.time) >= kPause) out += end(begun);
  for (const char c : bytes) {
    if (is_full(begun, c)) out += end(begun);
    if (begun.bytes.empty()) begun.first_time = traffic.time;
    begun.bytes += c;
  }
  begun.last_time = traffic.time;
  // A handshake is news at once.
  if (!look_.is_hex && !bytes.empty() && is_handshake(bytes.back())) out += end(begun);
  return out;
}

std::string TrafficText::add(const client::Traffic& traffic) {
  if (traffic.what == "sent" || traffic.what == "received") {
    const bool is_sent = traffic.what == "sent";
    Begun& begun = is_sent ? sent_ : received_;
    Begun& other = is_sent ? received_ : sent_;
    std::string out;
    if (!other.bytes.empty() && is_line_end(other.bytes.back())) out = end(other);
    if (const auto bytes = bytes_of_hex(traffic.bytes)) {
      out += append(begun, *bytes, traffic);
      return out;
    }
    out += end(begun);
    return out + line(traffic.time, traffic.what, printable(traffic.bytes));
  }
  std::string out = flush();
  return out + line(traffic.time, traffic.what, printable(traffic.text));
}

}  // namespace dripline::cli
