// A setting "key=value": what is taken is printed so that it is taken again; what is refused
// changes nothing.
#include <cstdint>
#include <cstdlib>

#include "protocol/wire/line_settings.hpp"

namespace {

std::string printed(const dripline::wire::LineSettings& settings) {
  std::string text;
  for (const auto& row : dripline::wire::setting_rows()) text += row.get(settings) + '\n';
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::wire;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t split = input.find('=');
  if (split == std::string_view::npos) return 0;
  const std::string_view key = input.substr(0, split), value = input.substr(split + 1);
  LineSettings settings;
  if (!set_value(settings, key, value)) {
    if (printed(settings) != printed(LineSettings{})) std::abort();
    return 0;
  }
  LineSettings again;
  for (const auto& row : setting_rows()) {
    if (!row.set(again, row.get(settings))) std::abort();
  }
  if (printed(again) != printed(settings)) std::abort();
  return 0;
}
