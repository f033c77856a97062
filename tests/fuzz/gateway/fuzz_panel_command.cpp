// A line of the machine's panel. Properties: it is understood or refused with a reason; what is
// understood is within its bounds, and the same line is understood the same again.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "gateway/app/panel/panel_command.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::gateway;
  const std::string_view line(reinterpret_cast<const char*>(data), size);
  const auto command = parse_panel_command(line);
  if (!command) return command.error().what.empty() ? std::abort(), 0 : 0;
  if (size > kMaxPanelLine || command->text.size() > size) std::abort();
  if (!(command->value >= 0 && command->value <= 1e6)) std::abort();
  if (parse_panel_command(line).value() != *command) std::abort();
  return 0;
}
