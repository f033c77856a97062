#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "clients/tools/comparison/motion_comparison.hpp"
#include "clients/tools/comparison/text_comparison.hpp"

namespace dripline::comparison {
namespace {

constexpr std::array<std::string_view, 6> kControls{
    "centurion", "fanuc", "rs274ngc", "tnc155", "tektronix-1704", "prototrak-plus"};
using interpreter::MemorySource;

/// The hunks turn the first text into the second.
void compare_texts(const std::string& a, const std::string& b, std::string_view control) {
  MemorySource first(a), second(b);
  const TextSide sides[]{{first, a.size(), control}, {second, b.size(), control}};
  const auto result = compare_text(sides[0], sides[1]);
  if (!result || result->is_same != (a == b)) __builtin_trap();
  std::string made;
  std::size_t at = 0;
  for (const TextHunk& hunk : result->hunks) {
    if (hunk.first.offset < at) __builtin_trap();
    made += a.substr(at, hunk.first.offset - at);
    made += b.substr(hunk.second.offset, hunk.second.size);
    at = hunk.first.offset + hunk.first.size;
  }
  if (made + a.substr(at) != b) __builtin_trap();
  if (!compare_text(sides[0], sides[1], {.normalized = true})) __builtin_trap();
}

/// A normal form is its own, and a program does what it does.
void compare_with_itself(const std::string& text, std::string_view control) {
  std::string once, twice;
  append_normal(text, lexical_rules(control), {.keeps_block_numbers = true}, once);
  append_normal(once, lexical_rules(control), {.keeps_block_numbers = true}, twice);
  if (once != twice) __builtin_trap();
  MemorySource first(text), second(text);
  const auto dialect = interpreter::find_dialect(control);
  const interpreter::Setup setup;
  const auto result = compare_motion({**dialect, setup, first}, {**dialect, setup, second},
                                     {.max_places = 10, .max_blocks = 2000});
  if (!result || !result->is_same) __builtin_trap();
}

}  // namespace
}  // namespace dripline::comparison

/// The control, then two texts with a NUL between them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline::comparison;
  if (size == 0) return 0;
  const std::string_view control = kControls[data[0] % kControls.size()];
  const std::string both(reinterpret_cast<const char*>(data + 1), size - 1);
  const std::size_t end = std::min(both.find('\0'), both.size());
  const std::string first = both.substr(0, end);
  compare_texts(first, both.substr(std::min(end + 1, both.size())), control);
  compare_with_itself(first, control);
  return 0;
}
