#include <cstddef>
#include <cstdint>
#include <string_view>

#include "gateway/interpreter/core/setup.hpp"

namespace dripline::interpreter {
namespace {

/// Any text either becomes a setup or an error with words; the options it keeps can be read.
void read_and_use(std::string_view text) {
  const auto setup = parse_setup(text);
  if (!setup) {
    if (setup.error().what.empty()) __builtin_trap();
    return;
  }
  for (const std::string_view key : {"reference", "pins", "stored_x", "circular"}) {
    (void)setup->control.flag(key, false);
    (void)setup->control.length(key, {});
    (void)setup->control.integers(key);
    (void)setup->control.positions(key);
  }
  Position to;
  to.set(Axis::X, Length::mm(100));
  to.set(Axis::Z, Length::mm(-100));
  (void)setup->workpiece.probe(setup->start, to, ProbeUntil::Contact);
  (void)setup->workpiece.probe(setup->start, to, ProbeUntil::Release);
}

}  // namespace
}  // namespace dripline::interpreter

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  dripline::interpreter::read_and_use({reinterpret_cast<const char*>(data), size});
  return 0;
}
