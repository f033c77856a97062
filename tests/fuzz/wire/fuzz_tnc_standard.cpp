// Both ends of a TNC's standard interface; the first byte says which.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size == 0) return 0;
  auto settings = wire::find_template("tnc155").value()->settings;
  settings.leader = data[0] / 2 % 8;
  if ((data[0] & 64) != 0) settings.hold_limit = std::chrono::seconds(30);
  const auto role = (data[0] & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 1, size - 1)));
  return 0;
}
