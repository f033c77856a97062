#include <nlohmann/json.hpp>

#include "protocol/pki/certificate.hpp"
#include "server/api/api.hpp"
#include "server/api/nullable_json.hpp"
#include "server/library/certificate_watch.hpp"

namespace dripline::api {
namespace {

using library::WatchedCertificate;
using nlohmann::json;
using Use = WatchedCertificate::Use;

std::vector<WatchedCertificate> known_certificates(const Services& services) {
  std::vector<WatchedCertificate> all;
  const ServerFacts& facts = services.facts;
  if (facts.certificate_expires)
    all.push_back({.use = Use::Https, .expires = *facts.certificate_expires});
  if (facts.dds_certificate_expires)
    all.push_back({.use = Use::Dds, .expires = *facts.dds_certificate_expires});
  for (const auto& view : services.machines.machines()) {
    if (!view.certificate_expires) continue;
    all.push_back(
        {.use = Use::Gateway, .machine = view.machine.name, .expires = *view.certificate_expires});
  }
  return all;
}

json certificate_json(const WatchedCertificate& certificate, UtcTime now) {
  const auto left = pki::days_left(certificate.expires, now);
  const bool is_over = certificate.expires <= now;
  const bool is_near = left < pki::kExpiryWarning.count();
  return {{"use", library::to_string(certificate.use)},
          {"machine", text_or_null(certificate.machine)},
          {"expires", to_iso8601(certificate.expires)},
          {"days_left", left},
          {"state", is_over   ? "expired"
                    : is_near ? "expiring"
                              : "ok"}};
}

Response list_certificates(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  json list = json::array();
  for (const auto& certificate : known_certificates(services))
    list.push_back(certificate_json(certificate, services.clock.now()));
  return json_response(200, {{"certificates", std::move(list)}});
}

}  // namespace

void add_certificate_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/certificates", with(services, list_certificates));
}

}  // namespace dripline::api
