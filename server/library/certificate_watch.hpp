#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/library/health.hpp"

namespace dripline::library {

/// A certificate that server and machines depend on.
struct WatchedCertificate {
  enum class Use {
    Https,    ///< the server's, for its clients
    Dds,      ///< the server's, for the gateways
    Gateway,  ///< a gateway's, for the server
  };
  Use use = Use::Https;
  std::string machine = {};  ///< of a gateway
  UtcTime expires;
};

/// https, dds, gateway
std::string_view to_string(WatchedCertificate::Use use);

/// How a certificate is: Degraded in its last 30 days and after them. Pure.
Health::Finding judge_certificate(const WatchedCertificate& certificate, UtcTime now);

/// Reports certificates that are about to expire: to the health at every look, to the log at the
/// first one and then once a day. One thread.
class CertificateWatch {
 public:
  static constexpr std::chrono::hours kLogInterval{24};

  CertificateWatch(Health& health, const Clock& clock) : health_(health), clock_(clock) {}
  /// What is no longer among them is taken back from the health.
  void look(const std::vector<WatchedCertificate>& certificates);

 private:
  void log(const std::string& owner, const Health::Finding& finding);

  Health& health_;
  const Clock& clock_;
  std::map<std::string, SteadyTime> reported_;  ///< by owner: when it was logged
};

}  // namespace dripline::library
