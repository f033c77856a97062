// The calls of Client for serial ports.
#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;

Reply<std::vector<Port>> Client::ports() {
  return fetch_list<Port>(path_of("ports"), "ports");
}

Reply<Port> Client::port(std::string_view name) {
  return fetch<Port>(get(path_of("ports", name)));
}

Reply<Port> Client::save_port(const PortRequest& request) {
  nlohmann::json json{{"machine", request.machine},
                      {"address", request.address},
                      {"settings", request.settings},
                      {"enabled", request.enabled}};
  if (!request.line_template.empty()) json["template"] = request.line_template;
  if (!request.rules.empty()) json["rules"] = request.rules;
  return fetch<Port>(with_method("PUT", path_of("ports", request.name)), dumped(json));
}

Reply<void> Client::remove_port(std::string_view name) {
  return perform(with_method("DELETE", path_of("ports", name)));
}

Reply<Transfer> Client::send_programs(std::string_view port,
                                      const std::vector<std::string>& programs) {
  return fetch<Transfer>(with_method("POST", path_of("ports", port) + "/transfers"),
                         dumped({{"programs", programs}}));
}

Reply<void> Client::receive_program(std::string_view port) {
  return perform(with_method("POST", path_of("ports", port) + "/receive"));
}

Reply<void> Client::confirm_reset(std::string_view port) {
  return perform(with_method("POST", path_of("ports", port) + "/confirm-reset"));
}

Reply<void> Client::stop_transfer(std::string_view port) {
  return perform(with_method("DELETE", path_of("ports", port) + "/transfers"));
}

Reply<PortTest> Client::test_port(std::string_view name) {
  return fetch<PortTest>(with_method("POST", path_of("ports", name) + "/test"));
}

Reply<RuleVerdict> Client::test_rules(std::string_view name, std::string_view text) {
  return fetch<RuleVerdict>(with_method("POST", path_of("ports", name) + "/test-rules"),
                            dumped({{"text", text}}));
}

Reply<void> Client::recording(std::string_view name,
                              const std::function<bool(std::string_view)>& sink) {
  HttpRequest request = get(path_of("ports", name) + "/recording");
  request.on_body = sink;
  return perform(request);
}

Reply<PortTemplates> Client::port_templates() {
  return fetch<PortTemplates>(get(path_of("port-templates")));
}

}  // namespace dripline::client
