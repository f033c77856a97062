#include <limits>
#include <nlohmann/json.hpp>

#include "protocol/base/names.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/json_object.hpp"
#include "server/api/measurement_views.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

Response without_templates() {
  return error_response({Errc::Unsupported, "this server has no report templates"});
}

json with_text(const storage::ReportTemplateVersion& version) {
  json view = report_template_json(version);
  view["text"] = version.text;
  return view;
}

Response list_templates(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("templates", services.measurements->templates().list(),
                       report_template_json);
}

Response show_template(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  QueryReader query(request);
  const auto number =
      query.number("version", static_cast<std::uint64_t>(std::numeric_limits<int>::max()));
  if (auto good = query.finish(); !good) return error_response(good.error());
  return value_response(
      200, services.measurements->templates().find(request.parameter("name"), number), with_text);
}

Response push_template(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  return value_response(
      200, services.measurements->push(request.parameter("name"), request.body, request.who),
      report_template_json);
}

Response remove_template(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  const auto removed = services.measurements->remove(request.parameter("name"), request.who);
  return removed ? no_content() : error_response(removed.error());
}

Response list_assignments(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("assignments", services.measurements->templates().assignments(),
                       assignment_json);
}

Result<storage::TemplateAssignment> read_assignment(const Request& request) {
  const auto scope = storage::parse_template_scope(request.parameter("scope"));
  if (!scope) return fail(scope.error());
  storage::TemplateAssignment assignment{.scope = *scope,
                                         .subject = request.parameter("subject"),
                                         .name = request.parameter("template")};
  // A macro has the name of a program.
  const auto named = assignment.scope == storage::TemplateScope::Machine
                         ? check_machine_name(assignment.subject)
                         : check_program_name(assignment.subject);
  if (!named) return fail(named.error());
  if (request.body.empty()) return assignment;
  auto body = JsonObject::parse(request.body);
  if (!body) return fail(body.error());
  assignment.version = body->optional_unsigned("version");
  if (auto good = body->finish(); !good) return fail(good.error());
  return assignment;
}

Response assign_template(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  const auto assignment = read_assignment(request);
  if (!assignment) return error_response(assignment.error());
  const auto assigned = services.measurements->assign(*assignment, request.who);
  return assigned ? no_content() : error_response(assigned.error());
}

Response unassign_template(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_templates();
  const auto assignment = read_assignment(request);
  if (!assignment) return error_response(assignment.error());
  const auto done = services.measurements->unassign(*assignment, request.who);
  return done ? no_content() : error_response(done.error());
}

}  // namespace

void add_report_template_routes(Router& router, Services& services) {
  const std::string one = "/api/v1/report-templates/{name}";
  router.add("GET", "/api/v1/report-templates", with(services, list_templates));
  router.add("GET", one, with(services, show_template));
  router.add("PUT", one, with(services, push_template));
  router.add("DELETE", one, with(services, remove_template));
  const std::string all = "/api/v1/report-template-assignments";
  const std::string assignment = all + "/{scope}/{subject}/{template}";
  router.add("GET", all, with(services, list_assignments));
  router.add("PUT", assignment, with(services, assign_template));
  router.add("DELETE", assignment, with(services, unassign_template));
}

}  // namespace dripline::api
