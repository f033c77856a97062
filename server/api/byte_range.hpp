#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::api {

struct ByteRange {
  std::uint64_t first = 0;
  std::uint64_t length = 0;
};

/// One range of `size` bytes from a Range header: `bytes=a-b`, `bytes=a-`, `bytes=-n`. nullopt when
/// there is no header. Errors: LimitExceeded (it is after the end), Syntax, Unsupported (several
/// ranges).
Result<std::optional<ByteRange>> parse_byte_range(std::string_view header, std::uint64_t size);

}  // namespace dripline::api
