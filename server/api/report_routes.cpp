#include <nlohmann/json.hpp>

#include "server/api/routes.hpp"
#include "server/api/views.hpp"
#include "server/library/report_reader.hpp"

namespace dripline::api {
namespace {

nlohmann::json machine_report_json(const storage::MachineReport& report) {
  return {{"machine", report.machine},
          {"lines", report.lines},
          {"first", to_iso8601(report.first)},
          {"last", to_iso8601(report.last)}};
}

Response list_reports(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  storage::RunFilter filter;
  filter.machine = query.text("machine");
  filter.program = query.text("program");
  filter.with_outputs = true;
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto runs = services.runs.runs(filter, page);
  if (!runs) return error_response(runs.error());
  auto list = nlohmann::json::array();
  for (const auto& run : *runs) list.push_back(report_json(run));
  return json_response(200, {{"reports", std::move(list)}});
}

Response list_machine_reports(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto reports = services.runs.machine_reports();
  if (!reports) return error_response(reports.error());
  auto list = nlohmann::json::array();
  for (const auto& report : *reports) list.push_back(machine_report_json(report));
  return json_response(200, {{"reports", std::move(list)}});
}

std::string content_type(library::ReportFormat format) {
  switch (format) {
    case library::ReportFormat::Text:
      return "text/plain; charset=utf-8";
    case library::ReportFormat::Csv:
      return "text/csv; charset=utf-8";
    case library::ReportFormat::Json:
      return "application/json";
  }
  return "text/plain";
}

Response send(const std::shared_ptr<library::ReportReader>& reader, library::ReportFormat format) {
  Response response;
  response.content_type = content_type(format);
  response.source = [reader] { return reader->next(); };
  return response;
}

/// The lines that the machine printed outside any run.
Response send_machine_report(Services& services, const Request& request) {
  QueryReader query(request);
  const auto format = library::parse_report_format(query.text("format").value_or("text"));
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!format) return error_response(format.error());
  const auto report = services.runs.machine_report(request.parameter("name"), *format);
  if (!report) return error_response(report.error());
  return send(*report, *format);
}

Response send_report(Services& services, const Request& request) {
  QueryReader query(request);
  const auto format = library::parse_report_format(query.text("format").value_or("text"));
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!format) return error_response(format.error());
  const auto report = services.runs.report(request.parameter("run"), *format);
  if (!report) return error_response(report.error());
  return send(*report, *format);
}

}  // namespace

void add_report_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machine-reports",
             [&](const Request& request) { return list_machine_reports(services, request); });
  router.add("GET", "/api/v1/machines/{name}/report",
             [&](const Request& request) { return send_machine_report(services, request); });
  router.add("GET", "/api/v1/reports",
             [&](const Request& request) { return list_reports(services, request); });
  router.add("GET", "/api/v1/reports/{run}",
             [&](const Request& request) { return send_report(services, request); });
}

}  // namespace dripline::api
