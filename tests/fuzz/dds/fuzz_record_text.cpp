// Any text either is refused with words or becomes a value that survives the round trip; the first
// byte selects the kind as which it is read.
#include <cstddef>
#include <cstdint>

#include "protocol/dds/record_text.hpp"

namespace {

template <class T>
void check(const dripline::Result<T>& value, dripline::Result<T> (*decode)(std::string_view)) {
  if (!value) {
    if (value.error().what.empty()) __builtin_trap();
    return;
  }
  const auto again = decode(dripline::dds::encode(*value));
  // Escaping may make a text longer than a record can be; nothing else may be refused.
  if (!again && again.error().code == dripline::Errc::LimitExceeded) return;
  if (!again || *again != *value) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::dds;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  switch (data[0] % 4) {
    case 0:
      check(decode_run_start(text), decode_run_start);
      break;
    case 1:
      check(decode_run_end(text), decode_run_end);
      break;
    case 2:
      check(decode_alarm(text), decode_alarm);
      break;
    default:
      check(decode_probe(text), decode_probe);
      break;
  }
  return 0;
}
