#pragma once

#include <span>
#include <string_view>

namespace dripline::web {

/// One file of the page, as it is sent: compressed with gzip when the page was built.
struct Asset {
  std::string_view path;  ///< "" is the page itself, the rest are "assets/NAME-HASH.js" ...
  std::string_view content_type;
  std::string_view etag;  ///< in quotes
  std::string_view gzip;
};

/// What was built into this program from clients/web; empty when it was built without node.
std::span<const Asset> embedded_assets();

}  // namespace dripline::web
