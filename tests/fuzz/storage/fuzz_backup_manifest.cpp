// The text of a backup's manifest, as it is and with a digest that fits. Properties: a file lies
// within its folder and has the chunks of its size; what was read is written and read alike.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "storage/backup/manifest.hpp"
#include "storage/programs/chunk_codec.hpp"

namespace {

using namespace dripline;

void look_at(const std::string& text) {
  const auto read = backup::parse_manifest(text);
  if (!read) return;
  for (const auto& file : read->files) {
    const bool is_inside = file.name.find('/') == std::string::npos && file.name != ".." &&
                           file.name != "." && !file.name.empty();
    const std::uint64_t room = file.chunks.size() * storage::kChunkBytes;
    if (!is_inside || file.size > room || room - file.size >= storage::kChunkBytes) std::abort();
  }
  const std::string written = backup::to_text(*read);
  const auto again = backup::parse_manifest(written);
  if (!again || backup::to_text(*again) != written) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  look_at(text);
  auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return 0;
  json.erase("digest");
  try {
    json["digest"] = sha256(json.dump()).hex();
  } catch (const nlohmann::json::exception&) {
    return 0;  // a text that is no UTF-8
  }
  look_at(json.dump());
  return 0;
}
