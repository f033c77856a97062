#include <cstdint>
#include <string_view>

#include "gateway/interpreter/dialects/centurion/memory/parameter_text.hpp"
#include "protocol/base/invariant.hpp"

/// The parameters of a Centurion as text, and the map of their numbers. Up to the first zero byte:
/// the map; after it the text. A text that is accepted can be written again without a syntax error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  using namespace dripline::interpreter::centurion;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto end = bytes.find('\0');
  const std::string_view text = end == std::string_view::npos ? bytes : bytes.substr(end + 1);
  const auto map = read_parameter_map(bytes.substr(0, end));
  (void)setup_of_parameter_text(text);
  if (!map) return 0;
  for (const ParameterMap::Row& row : map->rows) {
    invariant(row.ours >= 500 && row.ours < 1000 && row.control >= 200, "a row is in its limits");
  }
  (void)setup_of_parameter_text(text, &*map);
  return 0;
}
