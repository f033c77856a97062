#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/bodies/program_bodies.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

json import_json(const storage::Import& import) {
  const storage::Revision& revision = import.revision;
  json view{{"program", revision.program},
            {"revision", revision.number},
            {"machine", import.machine},
            {"control", text_or_null(revision.control)},
            {"size", revision.size},
            {"sha256", revision.content.hex()},
            {"comment", text_or_null(revision.comment)},
            {"received", to_iso8601(revision.created)},
            {"state", storage::to_string(import.state)},
            {"class", nullptr},
            {"base", nullptr},
            {"fault", nullptr},
            {"compared", nullptr},
            {"decided", time_or_null(import.decided)},
            {"who", text_or_null(import.who)},
            {"reason", text_or_null(import.reason)},
            {"at_once", import.is_at_once},
            {"accepted_as", nullptr}};
  if (const auto& found = import.compared) {
    view["class"] = text_or_null(found->edit);
    if (found->base) view["base"] = *found->base;
    view["fault"] = text_or_null(found->fault);
    view["compared"] = to_iso8601(found->time);
  }
  if (!import.target.empty())
    view["accepted_as"] = {{"program", import.target}, {"revision", import.target_revision}};
  return view;
}

Response without_queue() {
  return error_response({Errc::Unsupported, "this server has no import queue"});
}

Response list_imports(Services& services, const Request& request) {
  if (services.imports == nullptr) return without_queue();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const std::string state = query.text("state").value_or("pending");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (state != "pending" && state != "decided") {
    return error_response(
        {Errc::Syntax, fmt::format("query parameter 'state' is '{}': pending or decided", state)});
  }
  return list_response("imports", services.imports->list(state == "pending", page), import_json);
}

Response show_import(Services& services, const Request& request) {
  if (services.imports == nullptr) return without_queue();
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto shown = services.imports->show(request.parameter("name"), *number);
  if (!shown) return error_response(shown.error());
  json view = import_json(shown->import);
  view["compared_with"] = shown->base ? json(shown->base->number) : json(nullptr);
  view["comparison_fault"] = text_or_null(shown->fault);
  auto comparison = json::parse(shown->comparison, nullptr, false);
  if (comparison.is_object()) view["comparison"] = std::move(comparison);
  return json_response(200, view);
}

Response accept_import(Services& services, const Request& request) {
  if (services.imports == nullptr) return without_queue();
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto body = decode_acceptance(request.body);
  if (!body) return error_response(body.error());
  const bool is_moved = !body->target.empty();
  const auto accepted = services.imports->decide(
      {.program = request.parameter("name"),
       .revision = *number,
       .state = is_moved ? storage::ImportState::AcceptedAs : storage::ImportState::Accepted,
       .target = body->target,
       .who = request.who,
       .reason = body->reason});
  if (!accepted) return error_response(accepted.error());
  return json_response(200, revision_json(*accepted, services.programs.title(*accepted)));
}

Response reject_import(Services& services, const Request& request) {
  if (services.imports == nullptr) return without_queue();
  const auto number = revision_number(request);
  if (!number) return error_response(number.error());
  const auto reason = decode_rejection(request.body);
  if (!reason) return error_response(reason.error());
  const auto rejected = services.imports->decide({.program = request.parameter("name"),
                                                  .revision = *number,
                                                  .state = storage::ImportState::Rejected,
                                                  .who = request.who,
                                                  .reason = *reason});
  return rejected ? no_content() : error_response(rejected.error());
}

}  // namespace

std::function<void(const storage::Import&)> publish_imports_to(EventHub& hub) {
  return [&hub](const storage::Import& import) {
    if (!hub.has_listeners()) return;
    hub.publish({.kind = "import",
                 .machine = import.machine,
                 .data = to_text(import_json(import)),
                 .port = {}});
  };
}

void add_import_routes(Router& router, Services& services) {
  const std::string import = "/api/v1/imports/{name}/{number}";
  router.add("GET", "/api/v1/imports", with(services, list_imports));
  router.add("GET", import, with(services, show_import));
  router.add("POST", import + "/accept", with(services, accept_import));
  router.add("POST", import + "/reject", with(services, reject_import));
}

}  // namespace dripline::api
