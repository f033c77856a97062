#pragma once

#include <gtest/gtest.h>

#include "clients/tools/authority/signing.hpp"

/// Certificates for tests, made with the library that `dnc pki` uses.
namespace dripline::pki::test {

using authority::Purpose;
using authority::Request;
using authority::Signer;

inline const UtcTime kNow{std::chrono::days(20'000)};

inline authority::Validity around_now() {
  return {kNow - std::chrono::days(10), kNow + std::chrono::days(100)};
}

inline Signer make_signer(Purpose purpose, const std::string& name) {
  const auto key = authority::make_key().value();
  const Request request{.purpose = purpose,
                        .shop = "shop",
                        .unit = "authority",
                        .name = name,
                        .serial = authority::new_serial(),
                        .validity = around_now()};
  return {authority::make_root(request, key).value(), key};
}

inline Signer make_identity(const Signer& signer, const std::string& name,
                            const authority::Validity& validity = around_now(),
                            const std::string& serial = authority::new_serial()) {
  const auto key = authority::make_key().value();
  const Request request{.purpose = Purpose::Identity,
                        .shop = "shop",
                        .unit = "gateway",
                        .name = name,
                        .serial = serial,
                        .validity = validity};
  return {authority::make_certificate(request, key, signer).value(), key};
}

}  // namespace dripline::pki::test
