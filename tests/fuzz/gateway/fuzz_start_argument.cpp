// Where an order says that a run begins. Properties: it is understood or refused with a reason; the
// place holds no blank, and the same text is understood the same again.
#include <cstdint>
#include <cstdlib>

#include "gateway/app/run/start_argument.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::gateway;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto start = parse_start_argument(text);
  if (!start) return start.error().what.empty() ? std::abort(), 0 : 0;
  if (start->place.find(' ') != std::string::npos || start->pass == 0U) std::abort();
  if (parse_start_argument(text).value() != *start) std::abort();
  return 0;
}
