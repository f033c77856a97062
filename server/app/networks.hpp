#pragma once

#include <optional>

#include "protocol/dds/endpoint.hpp"
#include "server/api/http_server.hpp"
#include "server/app/settings.hpp"

/// The networks that the settings ask for. What would let strangers in is refused here.
namespace dripline::app {

/// How DDS is opened, and until when that is possible.
struct DdsNetwork {
  dds::NetworkOptions options;
  std::optional<UtcTime> certificate_expires = {};  ///< nullopt: without dds-security
};

/// Errors: Denied (an open network without security or consent), those of open_security_folder.
Result<DdsNetwork> dds_network(const Settings& settings, UtcTime now);

/// Errors: Denied (the address; TLS by half, or missing beyond loopback).
Result<api::HttpOptions> http_options(const Settings& settings);

/// nullopt: there is no MTConnect agent. Errors: Denied.
Result<std::optional<api::HttpOptions>> mtconnect_options(const Settings& settings);

/// Without TLS, and where the server will refuse to start anyway: nullopt.
std::optional<UtcTime> https_certificate_expiry(const Settings& settings);

}  // namespace dripline::app
