#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

Response list_machines(Services& services, const Request& request) {
  constexpr std::uint64_t kDefaultLimit = 100;
  QueryReader query(request);
  const machines::MachinePage page{
      .after = query.text("after").value_or(""),
      .limit = query.number("limit", kMaxLimit).value_or(kDefaultLimit)};
  if (auto good = query.finish(); !good) return error_response(good.error());
  auto list = nlohmann::json::array();
  for (const auto& view : services.machines.machines_after(page))
    list.push_back(machine_json(view));
  return json_response(200, {{"machines", std::move(list)}});
}

Response show_machine(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return value_response(200, services.machines.machine(request.parameter("name")), machine_json);
}

Response remove_from_list(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto removed = services.machines.remove(request.parameter("name"), request.who);
  return removed ? no_content() : error_response(removed.error());
}

}  // namespace

void add_machine_list_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machines", with(services, list_machines));
  router.add("GET", "/api/v1/machines/{name}", with(services, show_machine));
  router.add("DELETE", "/api/v1/machines/{name}", with(services, remove_from_list));
}

}  // namespace dripline::api
