#include "protocol/wire/line_settings.hpp"

namespace dripline::wire {

double bits_per_character(const LineSettings& settings) {
  const double stop = settings.stop_bits == StopBits::One   ? 1.0
                      : settings.stop_bits == StopBits::Two ? 2.0
                                                            : 1.5;
  return 1.0 + settings.data_bits + (settings.parity == Parity::None ? 0.0 : 1.0) + stop;
}

double characters_per_second(const LineSettings& settings) {
  return settings.baud / bits_per_character(settings);
}

std::chrono::nanoseconds character_time(const LineSettings& settings) {
  return std::chrono::nanoseconds(
      static_cast<std::int64_t>(1e9 * bits_per_character(settings) / settings.baud));
}

bool is_held_by_cts(const LineSettings& settings) {
  if (settings.flow == Flow::RtsCts) return true;
  return settings.flow == Flow::Heidenhain && settings.heidenhain.stop != TncStop::Dc3;
}

Result<void> set_value(LineSettings& settings, std::string_view key, std::string_view value) {
  for (const SettingRow& row : setting_rows()) {
    if (row.key == key) return row.set(settings, value);
  }
  return fail(Errc::NotFound, "there is no line setting '{}'", key);
}

}  // namespace dripline::wire
