#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/audited.hpp"
#include "server/api/bodies/run_bodies.hpp"

/// One axis of a machine without a run.

namespace dripline::api {

namespace {

using nlohmann::json;

/// The answer comes when the axis rests.
Response jog(Services& services, const Request& request) {
  const auto move = decode_jog(request.body);
  if (!move) return error_response(move.error());
  const std::string name = request.parameter("name");
  if (const auto view = services.machines.machine(name); !view) return error_response(view.error());
  const machines::JogRequest asked{name, interpreter::to_text(*move), request.given};
  const auto answer = ask_audited(
      services.audit,
      {.who = request.who, .action = "machine.jog", .subject = name, .detail = asked.move},
      [&] { return services.machines.jog(asked); });
  if (!answer) return error_response(answer.error());
  json view = json::parse(answer->details, nullptr, false);
  if (!view.is_object()) view = json::object();
  view["machine"] = name;
  view["text"] = answer->text;
  return json_response(200, view);
}

/// Not in the audit trail: it lets a jog move that is there, up to the end that is there.
Response keep_jog(Services& services, const Request& request) {
  const auto hold = decode_jog_keep(request.body);
  if (!hold) return error_response(hold.error());
  const std::string name = request.parameter("name");
  if (const auto view = services.machines.machine(name); !view) return error_response(view.error());
  const auto kept = services.machines.jog({name, interpreter::keep_text(*hold), request.given});
  if (!kept) return error_response(kept.error());
  return json_response(200, {{"machine", name}, {"held", true}});
}

}  // namespace

void add_jog_routes(Router& router, Services& services) {
  router.add("POST", "/api/v1/machines/{name}/jog", with(services, jog), Waits::ForMachine);
  router.add("POST", "/api/v1/machines/{name}/jog/hold", with(services, keep_jog),
             Waits::ForMachine);
}

}  // namespace dripline::api
