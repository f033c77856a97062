// A sample of FUZZED_MESSAGE either fails its check with words, or is a message that survives
// encoding and decoding unchanged.
#include "protocol/dds/impl/decode.hpp"
#include "protocol/dds/impl/encode.hpp"
#include "sample_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  using Sample = dds::SampleOf<dds::FUZZED_MESSAGE>;
  Sample sample{};
  dds::fuzz::SampleReader reader({data, size});
  reader.read<dds::FUZZED_MESSAGE>(sample);
  const auto message = dds::decode(sample);
  if (!message) {
    if (message.error().what.empty()) __builtin_trap();
    return 0;
  }
  Sample again{};
  if (!dds::encode(*message, again)) __builtin_trap();
  const auto returned = dds::decode(again);
  if (!returned || *returned != *message) __builtin_trap();
  return 0;
}
