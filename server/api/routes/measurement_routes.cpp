#include <nlohmann/json.hpp>

#include "clients/tools/measurement_files/text_files.hpp"
#include "protocol/base/names.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/json_object.hpp"
#include "server/api/measurement_files.hpp"
#include "server/api/measurement_reading.hpp"
#include "server/api/measurement_views.hpp"
#include "server/api/views.hpp"

namespace dripline::api {

namespace {

using measurement::Measurement;
using nlohmann::json;

/// `TIME:ID`, as an answer names the place of its last row; opaque to clients.
std::string place_text(const Measurement& last) {
  return fmt::format("{}:{}", last.time.time_since_epoch().count(), last.id);
}

Result<std::optional<storage::MeasurementPlace>> read_place(QueryReader& query) {
  const auto text = query.text("after");
  if (!text) return std::optional<storage::MeasurementPlace>();
  const auto colon = text->find(':');
  const auto time = parse_unsigned(std::string_view(*text).substr(0, colon));
  const auto id =
      parse_unsigned(colon == std::string::npos ? "" : std::string_view(*text).substr(colon + 1));
  if (!time || !id || *time > kMaxNumber || *id > kMaxNumber)
    return fail(Errc::Syntax, "query parameter 'after' is '{}': the 'next' of an answer", *text);
  return std::optional(storage::MeasurementPlace{
      UtcTime{std::chrono::microseconds{static_cast<std::int64_t>(*time)}}, *id});
}

/// All rows, piece by piece: memory does not grow with them, time grows in proportion.
class MeasurementExport {
 public:
  MeasurementExport(storage::MeasurementStore& store, storage::MeasurementFilter filter,
                    bool is_csv)
      : store_(store), filter_(std::move(filter)), is_csv_(is_csv) {}

  Result<std::optional<std::string>> next() {
    if (is_done_) return std::nullopt;
    std::string text;
    if (!place_ && is_csv_) text = measurement_files::csv_head();
    const auto rows = store_.list(filter_, place_, kMaxLimit);
    if (!rows) return fail(rows.error());
    for (const Measurement& row : *rows)
      text += is_csv_ ? measurement_files::csv_line(row) : to_text(measurement_json(row)) + "\n";
    is_done_ = rows->size() < kMaxLimit;
    if (!rows->empty()) place_ = storage::MeasurementPlace{rows->back().time, rows->back().id};
    return text;
  }

 private:
  storage::MeasurementStore& store_;
  const storage::MeasurementFilter filter_;
  const bool is_csv_;
  std::optional<storage::MeasurementPlace> place_;
  bool is_done_ = false;
};

Response export_measurements(storage::MeasurementStore& store, storage::MeasurementFilter filter,
                             bool is_csv) {
  auto source = std::make_shared<MeasurementExport>(store, std::move(filter), is_csv);
  Response response;
  response.content_type = is_csv ? "text/csv; charset=utf-8" : "application/x-ndjson";
  response.source = [source] { return source->next(); };
  return response;
}

Response list_measurements(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  QueryReader query(request);
  const auto filter = read_measurement_filter(query);
  if (!filter) return error_response(filter.error());
  const auto place = read_place(query);
  if (!place) return error_response(place.error());
  const auto limit = query.number("limit", kMaxLimit).value_or(100);
  const std::string order = query.text("order").value_or("oldest");
  const std::string format = query.text("format").value_or("json");
  const std::string x = query.text("x").value_or("radius");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (order != "oldest" && order != "newest") {
    return error_response(
        {Errc::Syntax, fmt::format("query parameter 'order' is '{}': oldest or newest", order)});
  }
  auto& store = services.measurements->stored();
  if (format == "csv" || format == "jsonl")
    return export_measurements(store, *filter, format == "csv");
  if (format != "json") return file_response(store, *filter, format, x);
  const auto rows = order == "newest" ? store.list_newest(*filter, *place, limit)
                                      : store.list(*filter, *place, limit);
  if (!rows) return error_response(rows.error());
  json view{{"measurements", json::array()}, {"next", nullptr}};
  for (const Measurement& row : *rows) view["measurements"].push_back(measurement_json(row));
  if (!rows->empty() && rows->size() == limit) view["next"] = place_text(rows->back());
  return json_response(200, view);
}

Response list_characteristics(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  QueryReader query(request);
  const auto machine = query.text("machine");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto names = services.measurements->stored().characteristics(machine);
  if (!names) return error_response(names.error());
  return json_response(200, {{"characteristics", *names}});
}

Result<storage::PartFilter> read_part_filter(QueryReader& query) {
  storage::PartFilter filter;
  filter.machine = query.text("machine");
  filter.run = query.text("run");
  const auto verdict = read_verdict(query);
  if (!verdict) return fail(verdict.error());
  filter.verdict = *verdict;
  filter.with_superseded = query.flag("superseded");
  return filter;
}

Response list_parts(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const auto filter = read_part_filter(query);
  if (!filter) return error_response(filter.error());
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("parts", services.measurements->stored().parts(*filter, page), part_json);
}

Response show_part(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  const auto id = parse_unsigned(request.parameter("id"));
  if (!id) return error_response(id.error());
  return value_response(200, services.measurements->stored().part(*id), part_json);
}

Response list_findings(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  QueryReader query(request);
  const storage::Page page = read_page(query);
  storage::PartFilter filter;
  filter.machine = query.text("machine");
  filter.run = query.text("run");
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("findings", services.measurements->stored().findings(filter, page),
                       finding_json);
}

/// `{template?, version?}`, or nothing.
Response derive_again(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  std::optional<std::string> name;
  std::optional<std::uint64_t> version;
  if (!request.body.empty()) {
    auto body = JsonObject::parse(request.body);
    if (!body) return error_response(body.error());
    name = body->optional_text("template", kMaxMachineName);
    version = body->optional_unsigned("version");
    if (auto good = body->finish(); !good) return error_response(good.error());
  }
  const std::string run = request.parameter("id");
  const auto written = services.audit.write_before(
      {.who = request.who,
       .action = "run.derive",
       .subject = run,
       .detail = name ? fmt::format("report template {}{}", *name,
                                    version ? fmt::format(" version {}", *version) : "")
                      : "report templates in force"});
  if (!written) return error_response(written.error());
  const auto parts = services.measurements->derive(run, name, version);
  if (!parts) return error_response(parts.error());
  json view{{"parts", json::array()}};
  for (const auto& part : *parts) view["parts"].push_back(part_json(part));
  return json_response(200, view);
}

}  // namespace

std::function<void(const storage::MeasuredPart&)> publish_parts_to(EventHub& hub) {
  return [&hub](const storage::MeasuredPart& part) {
    if (!hub.has_listeners()) return;
    hub.publish(
        {.kind = "part", .machine = part.machine, .data = to_text(part_json(part)), .port = {}});
  };
}

void add_measurement_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/measurements", with(services, list_measurements));
  router.add("GET", "/api/v1/characteristics", with(services, list_characteristics));
  router.add("GET", "/api/v1/parts", with(services, list_parts));
  router.add("GET", "/api/v1/parts/{id}", with(services, show_part));
  router.add("GET", "/api/v1/report-findings", with(services, list_findings));
  router.add("POST", "/api/v1/runs/{id}/measurements", with(services, derive_again));
}

}  // namespace dripline::api
