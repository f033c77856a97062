// A request line's path and query, and a Range header. Properties: written with every byte escaped
// the target reads the same; a range lies within its size.
#include <fmt/format.h>
#include <cstdlib>

#include "server/api/request.hpp"

namespace {

std::string escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
  return escaped;
}

std::string write(const dripline::api::Target& target) {
  std::string text;
  for (const auto& segment : target.segments) text += "/" + escape(segment);
  text += "?";
  for (const auto& [name, value] : target.query) text += escape(name) + "=" + escape(value) + "&";
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto target = api::parse_target(text)) {
    const std::string written = write(*target);
    if (written.size() <= api::kMaxTarget) {
      const auto again = api::parse_target(written);
      if (!again || again->segments != target->segments || again->query != target->query) {
        std::abort();
      }
    }
  }
  constexpr std::uint64_t kSize = 1000;
  const auto range = api::parse_byte_range(text, kSize);
  if (range && *range) {
    if ((*range)->length == 0 || (*range)->first + (*range)->length > kSize) std::abort();
  }
  return 0;
}
