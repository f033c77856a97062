#include "server/api/api.hpp"

namespace dripline::api {
namespace {

/// The audit trail has it before the gateway is taken.
Response confirm_gateway(Services& services, const Request& request) {
  const std::string name = request.parameter("name");
  const auto view = services.machines.machine(name);
  if (!view) return error_response(view.error());
  if (auto written = services.audit.write_before(
          {.who = request.who, .action = "machine.confirm_gateway", .subject = name, .detail = ""});
      !written)
    return error_response(written.error());
  const auto confirmed = services.machines.confirm_gateway(name);
  services.audit.write({.who = request.who,
                        .action = "machine.confirm_gateway",
                        .subject = name,
                        .detail = confirmed ? *confirmed : "refused, " + confirmed.error().what});
  return confirmed ? no_content() : error_response(confirmed.error());
}

}  // namespace

void add_gateway_routes(Router& router, Services& services) {
  router.add("POST", "/api/v1/machines/{name}/confirm-gateway", with(services, confirm_gateway));
}

}  // namespace dripline::api
