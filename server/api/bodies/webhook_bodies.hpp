#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

/// The JSON bodies of requests about webhooks, decoded and checked. Pure. Errors: Syntax,
/// LimitExceeded; each names the member.
namespace dripline::api {

struct WebhookBody {
  std::string name, url;
  std::vector<std::string> kinds;
};
/// `{name, url, kinds?}`.
Result<WebhookBody> decode_webhook(std::string_view body);

}  // namespace dripline::api
