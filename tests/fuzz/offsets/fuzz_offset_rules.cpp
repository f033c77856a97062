// A machine's offset rules, and a setup that one of their values is written into: the same text for
// both. Properties: it is read or refused with a reason; a value that was written is there, and
// writing it again changes nothing.
#include <cstdint>
#include <cstdlib>

#include "server/offsets/offset_rule.hpp"
#include "server/offsets/setup_value.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::offsets;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto rules = parse_offset_rules(text);
  if (!rules && rules.error().what.empty()) std::abort();
  for (const char* name : {"T3.wear.X", "T3.Z", "G54.X", "#500"}) {
    const auto target = parse_setup_target(name);
    if (!target) std::abort();
    const auto once = with_value(text, *target, -0.125, 4);
    if (!once) continue;
    if (value_in_setup(*once, *target) != -0.125) std::abort();
    const auto twice = with_value(*once, *target, -0.125, 4);
    if (!twice || *twice != *once) std::abort();
  }
  return 0;
}
