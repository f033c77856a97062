// The calls of Client for report templates and measurements. Answers are the server's JSON.
#include <nlohmann/json.hpp>

#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;
using impl::with_number;
using impl::with_page;
using impl::with_query;

namespace {

std::string assignment_path(const TemplateAssignment& assignment) {
  return path_of("report-template-assignments", assignment.scope) + "/" +
         url_encode(assignment.subject) + "/" + url_encode(assignment.name);
}

std::string measurement_path(const MeasurementQuery& query) {
  std::string path = path_of("measurements");
  path = with_query(std::move(path), "machine", query.machine);
  path = with_query(std::move(path), "run", query.run);
  path = with_query(std::move(path), "characteristic", query.characteristic);
  path = with_query(std::move(path), "since", query.since);
  path = with_query(std::move(path), "until", query.until);
  path = with_query(std::move(path), "verdict", query.verdict);
  if (query.with_superseded) path = with_query(std::move(path), "superseded", "yes");
  return path;
}

}  // namespace

Reply<std::string> Client::report_templates() {
  return fetch_text(get(path_of("report-templates")));
}

Reply<std::string> Client::report_template(std::string_view name,
                                           std::optional<std::uint64_t> version) {
  return fetch_text(get(with_number(path_of("report-templates", name), "version", version)));
}

Reply<std::string> Client::push_report_template(std::string_view name, std::string_view text) {
  HttpRequest request = with_method("PUT", path_of("report-templates", name));
  request.content_type = "application/toml";
  return fetch_text(std::move(request), text);
}

Reply<void> Client::remove_report_template(std::string_view name) {
  return perform(with_method("DELETE", path_of("report-templates", name)));
}

Reply<std::string> Client::report_template_assignments() {
  return fetch_text(get(path_of("report-template-assignments")));
}

Reply<void> Client::assign_report_template(const TemplateAssignment& assignment) {
  nlohmann::json body = nlohmann::json::object();
  if (assignment.version) body["version"] = *assignment.version;
  return perform(with_method("PUT", assignment_path(assignment)), dumped(body));
}

Reply<void> Client::unassign_report_template(const TemplateAssignment& assignment) {
  return perform(with_method("DELETE", assignment_path(assignment)));
}

Reply<std::string> Client::measurements(const MeasurementQuery& query) {
  std::string path = measurement_path(query);
  path = with_number(std::move(path), "limit", query.limit);
  path = with_query(std::move(path), "after", query.after);
  return fetch_text(get(with_query(std::move(path), "order", query.newest_first ? "newest" : "")));
}

Reply<void> Client::export_measurements(const MeasurementQuery& query, std::string_view format,
                                        const std::function<bool(std::string_view)>& sink) {
  HttpRequest request = get(with_query(measurement_path(query), "format", format));
  request.on_body = sink;
  return perform(request);
}

Reply<std::string> Client::parts(const MeasurementQuery& query) {
  std::string path = with_query(path_of("parts"), "machine", query.machine);
  path = with_query(std::move(path), "run", query.run);
  path = with_query(std::move(path), "verdict", query.verdict);
  if (query.with_superseded) path = with_query(std::move(path), "superseded", "yes");
  return fetch_text(get(with_number(std::move(path), "limit", query.limit)));
}

Reply<std::string> Client::report_findings(const MeasurementQuery& query) {
  std::string path = with_query(path_of("report-findings"), "machine", query.machine);
  path = with_query(std::move(path), "run", query.run);
  return fetch_text(get(with_number(std::move(path), "limit", query.limit)));
}

Reply<std::string> Client::derive_measurements(std::string_view run, const std::string& name,
                                               std::optional<std::uint64_t> version) {
  nlohmann::json body = nlohmann::json::object();
  if (!name.empty()) body["template"] = name;
  if (version) body["version"] = *version;
  return fetch_text(with_method("POST", path_of("runs", run) + "/measurements"), dumped(body));
}

Reply<std::string> Client::archives(Page page) {
  return fetch_text(get(with_page(path_of("archives"), page)));
}

Reply<std::string> Client::make_archives() {
  return fetch_text(with_method("POST", path_of("archives")));
}

}  // namespace dripline::client
