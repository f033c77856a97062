// A checkpoint's bytes. Properties: without its seal it is refused; with one, what is read back
// has the same bytes again, and an interpreter takes its state or refuses it, unchanged.
#include <cstdint>
#include <cstdlib>

#include "gateway/app/restart/checkpoint.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace {

using namespace dripline;

void restore(const interpreter::Snapshot& snapshot) {
  const auto dialect = interpreter::find_dialect(snapshot.dialect);
  if (!dialect) return;
  interpreter::MemorySource source("");
  interpreter::EventSink sink;
  auto made = (*dialect)->make({}, source, sink);
  if (!made) std::abort();
  const Digest before = (*made)->snapshot().digest();
  const bool is_taken = (*made)->restore(snapshot).has_value();
  if (!is_taken && (*made)->snapshot().digest() != before) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  const report::Bytes content(bytes, bytes + size);
  if (gateway::decode_checkpoint("run", content)) std::abort();
  const report::Bytes whole = gateway::sealed_checkpoint("run", content);
  const auto read = gateway::decode_checkpoint("run", whole);
  if (!read) return 0;
  if (gateway::encode("run", *read) != whole) std::abort();
  restore(read->snapshot);
  return 0;
}
