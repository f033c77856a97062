#include "clients/tools/charts/measurement_chart.hpp"
#include "server/api/api.hpp"
#include "server/api/measurement_reading.hpp"

namespace dripline::api {

namespace {

/// What is drawn of which measurements.
struct ChartQuery {
  CharacteristicChoice of;
  charts::ChartRequest chart;
};

/// Names of the measurements are taken out, the rest is the picture's.
Result<ChartQuery> read_chart_query(const Request& request) {
  QueryReader reader(request);
  const auto of = read_characteristic_choice(reader);
  if (!of) return fail(of.error());
  const auto of_picture = reader.rest();
  if (auto good = reader.finish(); !good) return fail(good.error());
  auto chart = charts::parse_chart_request(of_picture);
  if (!chart) return fail(chart.error());
  return ChartQuery{*of, *std::move(chart)};
}

Response draw_chart(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  const auto query = read_chart_query(request);
  if (!query) return error_response(query.error());
  const auto rows = newest_measurements(services.measurements->stored(), query->of);
  if (!rows) return error_response(rows.error());
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
