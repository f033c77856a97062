#include "clients/tools/studies/capability_study.hpp"
#include "clients/tools/studies/gauge_study_of.hpp"
#include "server/api/api.hpp"
#include "server/api/measurement_reading.hpp"

namespace dripline::api {

namespace {

constexpr std::uint64_t kMaxSubgroup = 100;

Response show_capability(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  QueryReader query(request);
  const auto of = read_characteristic_choice(query);
  if (!of) return error_response(of.error());
  studies::CapabilityRequest wanted;
  wanted.lower = query.real("lower");
  wanted.upper = query.real("upper");
  wanted.settings.subgroup = query.number("subgroup", kMaxSubgroup).value_or(1);
  wanted.settings.confidence = query.real("confidence").value_or(wanted.settings.confidence);
  const auto shape = statistics::parse_shape(query.text("shape").value_or("normal"));
  if (!shape) return error_response(shape.error());
  wanted.settings.shape = *shape;
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto rows = newest_measurements(services.measurements->stored(), *of);
  if (!rows) return error_response(rows.error());
  const auto study = studies::study_capability(*rows, wanted);
  return study ? json_text_response(studies::to_json(*study).dump())
               : error_response(study.error());
}

Response show_gauge(Services& services, const Request& request) {
  if (services.measurements == nullptr) return without_measurements();
  QueryReader query(request);
  const auto of = read_characteristic_choice(query);
  if (!of) return error_response(of.error());
  const auto method = studies::parse_gauge_method(query.text("method").value_or("anova"));
  if (!method) return error_response(method.error());
  const auto tolerance = query.real("tolerance");
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (tolerance && *tolerance <= 0) {
    return error_response(
        {Errc::LimitExceeded,
         fmt::format("query parameter 'tolerance' is {}: its full width, above 0", *tolerance)});
  }
  const auto rows = newest_measurements(services.measurements->stored(), *of);
  if (!rows) return error_response(rows.error());
  const auto result = studies::study_gauge(*rows, *method, tolerance);
  return result ? json_text_response(studies::to_json(*result).dump())
                : error_response(result.error());
}

}  // namespace

void add_study_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/measurements/capability", with(services, show_capability));
  router.add("GET", "/api/v1/measurements/gauge", with(services, show_gauge));
}

}  // namespace dripline::api
