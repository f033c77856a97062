#include "protocol/pki/expected_host.hpp"

#include <openssl/x509_vfy.h>
#include <openssl/x509v3.h>

namespace dripline::pki {

Result<HostKind> expect_host(X509_VERIFY_PARAM* parameters, const std::string& host) {
  X509_VERIFY_PARAM_set_hostflags(
      parameters, X509_CHECK_FLAG_NEVER_CHECK_SUBJECT | X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
  if (host.empty()) return fail(Errc::Syntax, "no host to verify the certificate of");
  if (X509_VERIFY_PARAM_set1_ip_asc(parameters, host.c_str()) == 1) return HostKind::Address;
  if (X509_VERIFY_PARAM_set1_host(parameters, host.data(), host.size()) == 1) return HostKind::Name;
  return fail(Errc::Syntax, "'{}' is no name of a host", host);
}

bool is_other_host(long verify_result) {
  return verify_result == X509_V_ERR_HOSTNAME_MISMATCH ||
         verify_result == X509_V_ERR_IP_ADDRESS_MISMATCH;
}

}  // namespace dripline::pki
