// The body of PUT /uploads/{id}/content. Property: the verdict does not depend on how the text is
// cut; the first byte says how.
#include <algorithm>
#include <cstdlib>
#include <string>

#include "server/library/content_check.hpp"

namespace {

std::string judge(std::span<const std::byte> text, std::size_t piece) {
  dripline::library::ContentCheck check;
  while (!text.empty()) {
    const auto part = text.first(std::min(piece, text.size()));
    if (const auto good = check.feed(part); !good) return good.error().what;
    text = text.subspan(part.size());
  }
  const auto whole = check.finish();
  return whole ? "good" : whole.error().what;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto text = std::as_bytes(std::span(data + 1, size - 1));
  if (judge(text, text.size() + 1) != judge(text, std::size_t{data[0]} % 16 + 1)) std::abort();
  return 0;
}
