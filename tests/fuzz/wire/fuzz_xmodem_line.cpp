// Both ends of XMODEM; the first byte says which, and with which check it begins.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size == 0) return 0;
  auto settings = wire::find_template("xmodem").value()->settings;
  settings.xmodem_crc = (data[0] & 2) != 0;
  settings.retries = data[0] / 4 % 8;
  if ((data[0] & 32) != 0) settings.answer_limit.reset();
  const auto role = (data[0] & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 1, size - 1)));
  return 0;
}
