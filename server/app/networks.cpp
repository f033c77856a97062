#include "server/app/networks.hpp"

#include <algorithm>

#include "protocol/dds/security_folder.hpp"
#include "protocol/pki/certificate.hpp"
#include "protocol/process/log.hpp"
#include "server/api/api.hpp"

namespace dripline::app {

Result<DdsNetwork> dds_network(const Settings& settings, UtcTime now) {
  DdsNetwork result;
  auto& network = result.options;
  network.domain = settings.dds_domain;
  network.interface = settings.dds_interface;
  network.tag = settings.dds_tag;
  network.port = static_cast<std::uint16_t>(settings.dds_port);
  network.cells = settings.dds_cells;
  network.discovery_interval_ms = settings.discovery_interval_ms;
  network.lease_ms = settings.lease_ms;
  network.is_open_network_allowed = settings.dds_open_network;
  if (!settings.dds_security.empty()) {
    auto folder =
        dds::open_security_folder(settings.dds_security, {.role = dds::Role::Server}, now);
    if (!folder) return fail(folder.error());
    network.security = folder->files;
    result.certificate_expires = folder->certificate.not_after;
  }
  if (auto safe = dds::check_exposure(network); !safe) return fail(safe.error());
  if (network.is_open_network_allowed && !network.security)
    process::log_warning("DDS on {} has no authentication: keep its network to server and gateways",
                         network.interface);
  return result;
}

Result<api::HttpOptions> http_options(const Settings& settings) {
  const auto address = api::parse_http_address(settings.http);
  if (!address) return fail(Errc::Denied, "http: {}", address.error().what);
  if (settings.tls_certificate.empty() != settings.tls_key.empty()) {
    return fail(Errc::Denied, "tls-certificate and tls-key belong together: give both or none");
  }
  if (settings.tls_key.empty() && !settings.tls_client_ca.empty())
    return fail(Errc::Denied, "tls-client-ca: there are no certificates without tls-certificate");
  if (settings.tls_client_ca.empty() && !settings.tls_client_revoked.empty())
    return fail(Errc::Denied, "tls-client-revoked belongs to tls-client-ca: give both or none");
  api::HttpOptions options;
  options.address = *address;
  options.max_body = api::Api::kMaxBody;
  options.limits.connections = settings.http_connections;
  options.limits.per_address = settings.http_connections_per_address;
  options.limits.event_streams = settings.http_event_streams;
  if (!settings.tls_key.empty()) {
    options.tls = api::TlsFiles{.certificate = settings.tls_certificate,
                                .key = settings.tls_key,
                                .client_authority = settings.tls_client_ca};
  }
  if (auto safe = api::check_exposure(*address, options.tls.has_value()); !safe) {
    return fail(safe.error());
  }
  return options;
}

Result<std::optional<api::HttpOptions>> mtconnect_options(const Settings& settings) {
  if (settings.mtconnect.empty()) return std::nullopt;
  const auto address = api::parse_http_address(settings.mtconnect);
  if (!address) return fail(Errc::Denied, "mtconnect: {}", address.error().what);
  if (!address->is_loopback && !settings.mtconnect_open_network) {
    return fail(Errc::Denied,
                "mtconnect: anybody who reaches {} reads what all machines do; allow it with "
                "mtconnect-open-network yes, on a network of your own, or listen at 127.0.0.1",
                address->text());
  }
  api::HttpOptions options;
  options.address = *address;
  options.is_open = true;
  constexpr unsigned kHandlers = 4;  // they wait for nothing
  options.handler_threads = kHandlers;
  // DDS waits with select(): with those of the REST API below 1,000 files.
  constexpr std::uint32_t kBoth = 830, kWanted = 256;
  const std::uint32_t left = kBoth - std::min(settings.http_connections, kBoth);
  options.limits.connections = std::min(std::max(left, 16U), kWanted);
  return options;
}

std::optional<UtcTime> https_certificate_expiry(const Settings& settings) {
  if (settings.tls_certificate.empty()) return std::nullopt;
  const auto certificate = pki::read_certificate(settings.tls_certificate);
  return certificate ? std::optional(certificate->not_after) : std::nullopt;
}

}  // namespace dripline::app
