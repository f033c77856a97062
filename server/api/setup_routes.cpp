#include <nlohmann/json.hpp>

#include "protocol/base/names.hpp"
#include "server/api/routes.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

Response list_setups(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("setups", services.setups.list(request.parameter("name"), page), setup_json);
}

Response show_setup(Services& services, const Request& request) {
  QueryReader query(request);
  const auto number = query.number("revision", std::numeric_limits<std::int64_t>::max());
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto setup = services.setups.find(request.parameter("name"), number);
  if (!setup) return error_response(setup.error());
  auto view = setup_json(*setup);
  view["text"] = setup->text;
  return json_response(200, view);
}

/// The control that reads the text: the machine's, unless the server does not know the machine.
Result<std::string> control_of(Services& services, const std::string& machine,
                               const std::optional<std::string>& given) {
  const auto view = services.machines.machine(machine);
  const std::string known = view ? view->machine.control : "";
  if (known.empty() && given) return *given;
  if (known.empty()) {
    return fail(Errc::NotFound,
                "machine {} has not been seen yet: say which control it has (control=...)",
                machine);
  }
  if (given && *given != known) {
    return fail(Errc::Conflict, "machine {} is a {}, not a {}", machine, known, *given);
  }
  return known;
}

Response save_setup(Services& services, const Request& request) {
  QueryReader query(request);
  const auto control = query.text("control");
  library::SetupText text;
  text.comment = query.text("comment").value_or("");
  text.base = query.number("base", std::numeric_limits<std::int64_t>::max());
  if (auto good = query.finish(); !good) return error_response(good.error());
  text.machine = request.parameter("name");
  if (auto named = check_machine_name(text.machine); !named) return error_response(named.error());
  const auto resolved = control_of(services, text.machine, control);
  if (!resolved) return error_response(resolved.error());
  text.control = *resolved;
  text.text = request.body;
  const auto saved = services.setups.save(text, request.who);
  if (!saved) return error_response(saved.error());
  auto view = setup_json(saved->setup);
  view["unchanged"] = saved->is_unchanged;
  return json_response(saved->is_unchanged ? 200 : 201, view);
}

}  // namespace

void add_setup_routes(Router& router, Services& services) {
  const std::string machine = "/api/v1/machines/{name}";
  router.add("GET", machine + "/setups", with(services, list_setups));
  router.add("GET", machine + "/setup", with(services, show_setup));
  router.add("PUT", machine + "/setup", with(services, save_setup));
}

}  // namespace dripline::api
