// An archive's bytes. Properties: they are read to their end or refused with a reason, with the
// same result however they come.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "protocol/archive/archive_reader.hpp"

namespace {

using namespace dripline;

std::string read(std::string_view bytes, std::size_t piece) {
  auto reader = archive::ArchiveReader::begin(
      [bytes, piece]() mutable -> Result<std::span<const std::byte>> {
        const auto some = bytes.substr(0, piece);
        bytes.remove_prefix(some.size());
        return std::as_bytes(std::span(some));
      },
      "fuzzed");
  if (!reader) return reader.error().what;
  std::string all;
  for (;;) {
    const auto row = reader->next();
    if (!row) return row.error().what;
    if (!*row) return all;
    if ((*row)->size() > archive::kMaxLine) std::abort();
    all += **row + '\n';
    if (all.size() > 16 * archive::kMaxLine) return all;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (read(bytes, std::max<std::size_t>(1, size)) != read(bytes, 3)) std::abort();
  return 0;
}
