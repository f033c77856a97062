#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/bodies/webhook_bodies.hpp"
#include "server/api/nullable_json.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

/// Without its secret.
json webhook_json(const storage::Webhook& webhook) {
  return {{"name", webhook.name},
          {"url", webhook.url},
          {"kinds", webhook.kinds},
          {"author", webhook.author},
          {"created", to_iso8601(webhook.created)},
          {"delivered", webhook.delivered},
          {"delivered_at", time_or_null(webhook.delivered_at)},
          {"waiting", webhook.waiting},
          {"lost", webhook.lost},
          {"failures", webhook.failures},
          {"failing_since", time_or_null(webhook.failing_since)},
          {"fault", text_or_null(webhook.fault)}};
}

Response without_webhooks() {
  return error_response({Errc::Unsupported, "this server has no webhooks"});
}

Response list_webhooks(Services& services, const Request& request) {
  if (services.webhooks == nullptr) return without_webhooks();
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("webhooks", services.webhooks->list(), webhook_json);
}

Response add_webhook(Services& services, const Request& request) {
  if (services.webhooks == nullptr) return without_webhooks();
  const auto body = decode_webhook(request.body);
  if (!body) return error_response(body.error());
  const auto added = services.webhooks->add(
      {.name = body->name, .url = body->url, .kinds = body->kinds}, request.who);
  return value_response(201, added, [](const storage::Webhook& webhook) {
    json view = webhook_json(webhook);
    view["secret"] = webhook.secret;
    return view;
  });
}

Response remove_webhook(Services& services, const Request& request) {
  if (services.webhooks == nullptr) return without_webhooks();
  return empty_response(services.webhooks->remove(request.parameter("name"), request.who));
}

/// What the receiver answers is not passed on, only how it went.
Response test_webhook(Services& services, const Request& request) {
  if (services.webhooks == nullptr) return without_webhooks();
  const auto tested = services.webhooks->test(request.parameter("name"));
  if (!tested && tested.error().code == Errc::NotFound) return error_response(tested.error());
  return json_response(200, {{"delivered", tested.has_value()},
                             {"fault", tested ? json(nullptr) : json(tested.error().what)}});
}

}  // namespace

void add_webhook_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/webhooks", with(services, list_webhooks));
  router.add("POST", "/api/v1/webhooks", with(services, add_webhook));
  router.add("DELETE", "/api/v1/webhooks/{name}", with(services, remove_webhook),
             Waits::ForMachine);
  router.add("POST", "/api/v1/webhooks/{name}/test", with(services, test_webhook),
             Waits::ForMachine);
}

}  // namespace dripline::api
