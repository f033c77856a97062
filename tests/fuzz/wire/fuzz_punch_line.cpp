// Both ends of a line that reads and punches whole programs; the first byte says which.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size == 0) return 0;
  auto settings = wire::find_template(FUZZED_TEMPLATE).value()->settings;
  if ((data[0] & 2) != 0) settings.answer_limit.reset();
  if ((data[0] & 4) != 0) settings.end_character.reset();
  settings.trailer = data[0] / 8 % 8;
  const auto role = (data[0] & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 1, size - 1)));
  return 0;
}
