#include <algorithm>

#include "clients/tools/charts/measurement_chart.hpp"
#include "server/api/api.hpp"

namespace dripline::api {

namespace {

/// Points that a picture can show; the newest ones.
constexpr std::uint64_t kMaxCharted = 10'000;
constexpr std::uint64_t kUsuallyCharted = 1'000;

/// What is drawn of which measurements.
struct ChartQuery {
  storage::MeasurementFilter filter;
  std::uint64_t last = kUsuallyCharted;
  charts::ChartRequest chart;
};

/// Names of the measurements are taken out, the rest is the picture's.
Result<ChartQuery> read_chart_query(const Request& request) {
  QueryReader reader(request);
  ChartQuery query;
  query.filter.machine = reader.text("machine");
  query.filter.run = reader.text("run");
  query.filter.characteristic = reader.text("characteristic");
  if (!query.filter.characteristic) {
    return fail(Errc::Syntax, "query parameter 'characteristic' is missing: a chart is of one");
  }
  query.filter.since = reader.time("since");
  query.filter.until = reader.time("until");
  query.last = reader.number("last", kMaxCharted).value_or(kUsuallyCharted);
  const auto of_picture = reader.rest();
  if (auto good = reader.finish(); !good) return fail(good.error());
  if (query.last == 0) {
    return fail(Errc::LimitExceeded, "query parameter 'last' is 0: 1 to {}", kMaxCharted);
  }
  auto chart = charts::parse_chart_request(of_picture);
  if (!chart) return fail(chart.error());
  query.chart = *std::move(chart);
  return query;
}

/// The newest ones, oldest first.
Result<std::vector<measurement::Measurement>> newest(storage::MeasurementStore& store,
                                                     const ChartQuery& query) {
  std::vector<measurement::Measurement> all;
  std::optional<storage::MeasurementPlace> before;
  while (all.size() < query.last) {
    const std::uint64_t wanted = std::min<std::uint64_t>(kMaxLimit, query.last - all.size());
    const auto rows = store.list_newest(query.filter, before, wanted);
    if (!rows) return fail(rows.error());
    all.insert(all.end(), rows->begin(), rows->end());
    if (rows->size() < wanted) break;
    before = storage::MeasurementPlace{rows->back().time, rows->back().id};
  }
  std::ranges::reverse(all);
  return all;
}

Response draw_chart(Services& services, const Request& request) {
  if (services.measurements == nullptr)
    return error_response({Errc::Unsupported, "this server has no measurements"});
  const auto query = read_chart_query(request);
  if (!query) return error_response(query.error());
  const auto rows = newest(services.measurements->stored(), *query);
  if (!rows) return error_response(rows.error());
  if (rows->empty()) {
    return error_response({Errc::NotFound, fmt::format("nothing was measured of characteristic {}",
                                                       *query->filter.characteristic)});
  }
  auto svg = charts::measurements_svg(*rows, query->chart);
  if (!svg) return error_response(svg.error());
  Response response;
  response.content_type = "image/svg+xml; charset=utf-8";
  response.body = *std::move(svg);
  return response;
}

}  // namespace

void add_chart_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/measurements/chart", with(services, draw_chart));
}

}  // namespace dripline::api
