// The calls of Client for webhooks.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::path_of;
using impl::with_method;

Reply<std::vector<Webhook>> Client::webhooks() {
  return fetch_list<Webhook>(path_of("webhooks"), "webhooks");
}

Reply<Webhook> Client::add_webhook(const std::string& name, const std::string& url,
                                   const std::vector<std::string>& kinds) {
  nlohmann::json body{{"name", name}, {"url", url}};
  if (!kinds.empty()) body["kinds"] = kinds;
  return fetch<Webhook>(with_method("POST", path_of("webhooks")), dumped(body));
}

Reply<void> Client::remove_webhook(std::string_view name) {
  return perform(with_method("DELETE", path_of("webhooks", name)));
}

Reply<WebhookTest> Client::test_webhook(std::string_view name) {
  return fetch<WebhookTest>(with_method("POST", path_of("webhooks", name) + "/test"));
}

}  // namespace dripline::client
