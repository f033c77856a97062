#include "server/api/byte_range.hpp"

#include <algorithm>

#include "server/api/request.hpp"

namespace dripline::api {

Result<std::optional<ByteRange>> parse_byte_range(std::string_view header, std::uint64_t size) {
  if (header.empty()) return std::nullopt;
  constexpr std::string_view kUnit = "bytes=";
  if (!header.starts_with(kUnit)) return fail(Errc::Syntax, "Range '{}' is not in bytes", header);
  const std::string_view range = header.substr(kUnit.size());
  if (range.find(',') != std::string_view::npos) {
    return fail(Errc::Unsupported, "Range '{}': one range only", header);
  }
  const std::size_t dash = range.find('-');
  if (dash == std::string_view::npos) return fail(Errc::Syntax, "Range '{}' has no dash", header);
  const std::string_view from = range.substr(0, dash);
  const std::string_view to = range.substr(dash + 1);
  const auto first = from.empty() ? Result<std::uint64_t>{0} : parse_unsigned(from);
  const auto last = to.empty() ? Result<std::uint64_t>{size} : parse_unsigned(to);
  if (!first || !last || (from.empty() && to.empty())) {
    return fail(Errc::Syntax, "Range '{}' is not a range of numbers", header);
  }
  if (from.empty()) {  // the last n bytes
    const std::uint64_t length = std::min(*last, size);
    if (length == 0)
      return fail(Errc::LimitExceeded, "Range '{}' of {} bytes is empty", header, size);
    return ByteRange{.first = size - length, .length = length};
  }
  if (*first >= size || *last < *first) {
    return fail(Errc::LimitExceeded, "Range '{}' lies outside of {} bytes", header, size);
  }
  return ByteRange{.first = *first, .length = std::min(*last, size - 1) - *first + 1};
}

}  // namespace dripline::api
