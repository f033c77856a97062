#include <charconv>

#include "protocol/wire/impl/line_limits.hpp"
#include "protocol/wire/line_settings.hpp"

/// "9600e72": baud, parity, data bits, stop bits.
namespace dripline::wire {
namespace {

constexpr std::string_view kParityLetters = "neoms";  // in the order of Parity

std::string_view stop_bits_text(StopBits bits) {
  constexpr std::string_view kTexts[] = {"1", "1.5", "2"};
  return kTexts[static_cast<std::size_t>(bits)];
}

std::optional<StopBits> stop_bits_of(std::string_view text) {
  for (const StopBits bits : {StopBits::One, StopBits::OneAndHalf, StopBits::Two}) {
    if (stop_bits_text(bits) == text) return bits;
  }
  return std::nullopt;
}

tl::unexpected<Error> not_short_form(std::string_view text) {
  return fail(Errc::Syntax,
              "'{}' is not a line's short form: baud, one of n e o m s, 7 or 8, then 1, 1.5 or 2 "
              "(9600e72)",
              text);
}

}  // namespace

Result<void> apply_short_form(std::string_view text, LineSettings& settings) {
  unsigned baud = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), baud);
  if (error == std::errc::result_out_of_range) baud = kMaximumBaud + 1;
  const std::size_t digits = static_cast<std::size_t>(rest - text.data());
  if (digits == 0 || text.size() < digits + 3) return not_short_form(text);

  const char letter = text[digits];
  const std::size_t parity = kParityLetters.find(
      letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter);
  const char data = text[digits + 1];
  const std::optional<StopBits> stop = stop_bits_of(text.substr(digits + 2));
  if (parity == std::string_view::npos || (data != '7' && data != '8') || !stop) {
    return not_short_form(text);
  }
  if (baud < kMinimumBaud || baud > kMaximumBaud) {
    return fail(Errc::LimitExceeded, "line '{}': the baud rate is outside {} to {}", text,
                kMinimumBaud, kMaximumBaud);
  }
  settings.baud = baud;
  settings.parity = static_cast<Parity>(parity);
  settings.data_bits = static_cast<unsigned>(data - '0');
  settings.stop_bits = *stop;
  return {};
}

std::string short_form(const LineSettings& settings) {
  return fmt::format("{}{}{}{}", settings.baud,
                     kParityLetters[static_cast<std::size_t>(settings.parity)], settings.data_bits,
                     stop_bits_text(settings.stop_bits));
}

}  // namespace dripline::wire
