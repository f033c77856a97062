// A tape reader and the control that runs one; the first byte says which, the code and the faults.
#include "tests/fuzz/wire/line_script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  if (size == 0) return 0;
  const unsigned switches = data[0];
  const auto* name = (switches & 2) != 0 ? "tektronix1704-iso" : "tektronix1704";
  auto settings = wire::find_template(name).value()->settings;
  settings.leader = settings.trailer = 3;
  settings.reader.stops_at_end_of_block = (switches & 4) != 0;
  settings.reader.fault = static_cast<wire::ReaderFault>(switches / 8 % 5);
  settings.reader.fault_row = 20;
  const auto role = (switches & 1) != 0 ? wire::Role::Control : wire::Role::Host;
  fuzz::play_line_script(settings, role, std::as_bytes(std::span(data + 1, size - 1)));
  return 0;
}
