#pragma once

#include "server/api/api.hpp"

namespace dripline::api {

struct StoredContent {
  Digest digest;
  std::uint64_t size = 0;
};

/// Stored bytes as they are, or the range that the request asks for, piece by piece; or the error.
Response content_response(Services& services, const Request& request, const StoredContent& content);

}  // namespace dripline::api
