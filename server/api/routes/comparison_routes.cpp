#include "server/api/api.hpp"
#include "server/api/interpretation.hpp"

namespace dripline::api {
namespace {

constexpr std::uint64_t kMaxContext = 100;

Result<paths::CompareBy> read_by(const std::optional<std::string>& text) {
  if (!text || *text == "text") return paths::CompareBy::Text;
  if (*text == "normalized") return paths::CompareBy::Normalized;
  if (*text == "motion") return paths::CompareBy::Motion;
  return fail(Errc::Syntax, "query parameter 'by' is '{}': text, normalized or motion", *text);
}

Response refused_comparison(const Error& error) {
  constexpr int kUnavailable = 503;
  return error.code == Errc::Timeout ? error_response(kUnavailable, error)
                                     : refused_interpretation(error);
}

Response compare_programs(Services& services, const Request& request) {
  paths::ComparisonRequest compared;
  const std::string name = request.parameter("name");
  QueryReader query(request);
  const auto revision = query.number("revision", kMaxNumber);
  const auto other = query.text("other");
  const auto other_revision = query.number("other_revision", kMaxNumber);
  const auto by = read_by(query.text("by"));
  compared.machine = query.text("machine").value_or("");
  const auto tolerance = read_tolerance(query.text("tolerance"), compared.tolerance);
  compared.context = query.number("context", kMaxContext).value_or(compared.context);
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (!by) return error_response(by.error());
  if (!tolerance) return error_response(tolerance.error());
  compared.by = *by;
  compared.tolerance = *tolerance;
  const auto first = services.programs.revision(name, revision);
  if (!first) return error_response(first.error());
  const auto second = services.programs.revision(other.value_or(name), other_revision);
  if (!second) return error_response(second.error());
  compared.first = *first;
  compared.second = *second;
  auto result = services.paths.compare(compared);
  if (!result) return refused_comparison(result.error());
  return json_text_response(*std::move(result));
}

}  // namespace

void add_comparison_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/programs/{name}/comparison", with(services, compare_programs));
}

}  // namespace dripline::api
