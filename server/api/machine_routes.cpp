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
  const auto view = services.machines.machine(request.parameter("name"));
  return view ? json_response(200, machine_json(*view)) : error_response(view.error());
}

Response command_machine(Services& services, const Request& request) {
  auto command = decode_machine_command(request.body);
  if (!command) return error_response(command.error());
  command->machine = request.parameter("name");
  const auto done = services.machines.command(*command);
  // The gateway may have carried out the command although its answer is missing.
  const bool is_unknown = !done && done.error().code == Errc::Timeout;
  if (done || is_unknown) {
    services.audit.write({.who = request.who,
                          .action = fmt::format("machine.{}", dds::to_string(command->action)),
                          .subject = command->machine,
                          .detail = fmt::format("{} {} {}", command->argument, command->value,
                                                is_unknown ? "not answered" : "accepted")});
  }
  if (!done) return error_response(done.error());
  return json_response(200, {{"accepted", true}});
}

}  // namespace

void add_machine_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machines",
             [&](const Request& request) { return list_machines(services, request); });
  router.add("GET", "/api/v1/machines/{name}",
             [&](const Request& request) { return show_machine(services, request); });
  router.add(
      "POST", "/api/v1/machines/{name}/commands",
      [&](const Request& request) { return command_machine(services, request); },
      Waits::ForMachine);
}

}  // namespace dripline::api
