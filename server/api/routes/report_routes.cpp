#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/views.hpp"
#include "server/library/history/report_reader.hpp"

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
  return list_response("reports", services.runs.runs(filter, page), report_json);
}

Response list_machine_reports(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("reports", services.runs.machine_reports(), machine_report_json);
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
  router.add("GET", "/api/v1/machine-reports", with(services, list_machine_reports));
  router.add("GET", "/api/v1/machines/{name}/report", with(services, send_machine_report));
  router.add("GET", "/api/v1/reports", with(services, list_reports));
  router.add("GET", "/api/v1/reports/{run}", with(services, send_report));
}

}  // namespace dripline::api
