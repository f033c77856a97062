// Both ends of a TNC's blockwise transfer; the first byte says which, and the switches.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size == 0) return 0;
  auto settings = wire::find_template("tnc155-bcc").value()->settings;
  const unsigned switches = data[0];
  settings.heidenhain.line_end_in_block = (switches & 2) != 0;
  settings.heidenhain.bcc_is_printable = (switches & 4) != 0;
  settings.heidenhain.repeats_unanswered = (switches & 8) != 0;
  if ((switches & 16) != 0) settings.hold_limit = std::chrono::seconds(30);
  const auto role = (switches & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 1, size - 1)));
  return 0;
}
