#pragma once

#include <string_view>

#include "server/feeds/feed_control.hpp"

namespace dripline::feeds {

/// Where a run is to begin, as people write it: `N120` or `120` the block with that N number, `L7`
/// the seventh line, `B4096` a byte. Errors: Syntax.
Result<StartPoint> parse_start_point(std::string_view text);

}  // namespace dripline::feeds
