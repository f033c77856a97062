// Both ends of a Centurion's line; the first two bytes are its settings.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size < 2) return 0;
  auto settings = wire::find_template("centurion").value()->settings;
  settings.control.splits_programs = (data[0] & 2) != 0;
  settings.control.buffer_size = 1 + data[0] / 4 % 32;
  settings.control.dnc = static_cast<wire::DncMode>(data[1] % 5);
  settings.control.dnc_skip = data[1] / 5 % 4;
  if ((data[1] & 128) != 0) settings.end_character = '\x1a';
  const auto role = (data[0] & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 2, size - 2)));
  return 0;
}
