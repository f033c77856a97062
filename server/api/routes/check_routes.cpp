
#include "server/api/api.hpp"

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
  if (!result && result.error().code == Errc::Busy) {
    constexpr int kUnavailable = 503;
    Response response = error_response(kUnavailable, result.error());
    response.headers.emplace_back("Retry-After", "2");
    return response;
  }
  if (!result) return error_response(result.error());
  Response response;
  response.content_type = "application/json";
  response.body = *std::move(result);
  return response;
}

}  // namespace

void add_check_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/programs/{name}/check", with(services, check_program));
}

}  // namespace dripline::api
