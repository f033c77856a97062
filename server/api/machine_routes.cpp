#include <nlohmann/json.hpp>

#include "server/api/bodies.hpp"
#include "server/api/routes.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

Response list_machines(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  auto list = nlohmann::json::array();
  for (const auto& view : services.machines.machines()) list.push_back(machine_json(view));
  return json_response(200, {{"machines", std::move(list)}});
}

Response show_machine(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return value_response(200, services.machines.machine(request.parameter("name")), machine_json);
}

Response command_machine(Services& services, const Request& request) {
  auto command = decode_machine_command(request.body);
  if (!command) return error_response(command.error());
  command->machine = request.parameter("name");
  return carry_out(services, request, *command);
}

}  // namespace

void add_machine_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machines", with(services, list_machines));
  router.add("GET", "/api/v1/machines/{name}", with(services, show_machine));
  router.add("POST", "/api/v1/machines/{name}/commands", with(services, command_machine),
             Waits::ForMachine);
}

}  // namespace dripline::api
