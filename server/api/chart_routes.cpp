#include <algorithm>
#include <map>

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

std::optional<std::string> take(std::map<std::string, std::string>& texts,
                                const std::string& name) {
  const auto found = texts.find(name);
  if (found == texts.end()) return std::nullopt;
  std::string text = std::move(found->second);
  texts.erase(found);
  return text;
}

Result<std::optional<UtcTime>> take_time(std::map<std::string, std::string>& texts,
                                         const std::string& name) {
  const auto text = take(texts, name);
  if (!text) return std::optional<UtcTime>();
  const auto time = parse_iso8601(*text);
  if (!time) return fail(time.error().code, "query parameter '{}': {}", name, time.error().what);
  return std::optional(*time);
}

/// Names of the measurements are taken out, the rest is the picture's.
Result<ChartQuery> read_chart_query(const Request& request) {
  auto texts = request.target.query;
  ChartQuery query;
  query.filter.machine = take(texts, "machine");
  query.filter.run = take(texts, "run");
  query.filter.characteristic = take(texts, "characteristic");
  if (!query.filter.characteristic) {
    return fail(Errc::Syntax, "query parameter 'characteristic' is missing: a chart is of one");
  }
  const auto since = take_time(texts, "since");
  if (!since) return fail(since.error());
  query.filter.since = *since;
  const auto until = take_time(texts, "until");
  if (!until) return fail(until.error());
  query.filter.until = *until;
  if (const auto last = take(texts, "last")) {
    const auto number = parse_unsigned(*last);
    if (!number || *number == 0 || *number > kMaxCharted) {
      return fail(Errc::LimitExceeded, "query parameter 'last' is '{}': 1 to {}", *last,
                  kMaxCharted);
    }
    query.last = *number;
  }
  auto chart = charts::parse_chart_request(texts);
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
