#include "server/api/bodies/webhook_bodies.hpp"

#include "server/api/bodies/json_object.hpp"

namespace dripline::api {

Result<WebhookBody> decode_webhook(std::string_view body) {
  constexpr std::size_t kMaxUrl = 1024;
  constexpr std::size_t kMaxKinds = 16;
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  WebhookBody read;
  read.name = object->required_text("name", kMaxName);
  read.url = object->required_text("url", kMaxUrl);
  read.kinds = object->optional_texts("kinds", kMaxName, kMaxKinds);
  if (auto good = object->finish(); !good) return fail(good.error());
  return read;
}

}  // namespace dripline::api
