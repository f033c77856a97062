#include "server/api/api.hpp"
#include "server/api/interpretation.hpp"

namespace dripline::api {
namespace {

Response check_program(Services& services, const Request& request) {
  paths::CheckRequest checked;
  QueryReader query(request);
  const auto revision = query.number("revision", kMaxNumber);
  checked.machine = query.text("machine").value_or("");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto found = services.programs.revision(request.parameter("name"), revision);
  if (!found) return error_response(found.error());
  checked.revision = *found;
  auto result = services.paths.check(checked);
  if (!result) return refused_interpretation(result.error());
  return json_text_response(*std::move(result));
}

}  // namespace

void add_check_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/programs/{name}/check", with(services, check_program));
}

}  // namespace dripline::api
