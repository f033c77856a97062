#pragma once

#include <string_view>

/// The folder that one computer gets: `dnc pki` makes it, `--dds-security` of dncd and dncgw names
/// it.
namespace dripline::pki {

inline constexpr const char* kIdentityAuthorityFile = "identity_ca.pem";  ///< signs certificates
/// Signs permissions and governance. Another key than the first: anyone who holds a certificate of
/// the first could otherwise sign permissions for himself (Cyclone DDS accepts a chain of signers).
inline constexpr const char* kPermissionsAuthorityFile = "permissions_ca.pem";
inline constexpr const char* kCertificateFile = "certificate.pem";
inline constexpr const char* kKeyFile = "key.pem";  ///< the only secret
inline constexpr const char* kPermissionsFile = "permissions.p7s";
inline constexpr const char* kGovernanceFile = "governance.p7s";
inline constexpr const char* kRevokedFile = "revoked.pem";  ///< may be absent

// The organizational unit of a certificate states whose it is.
inline constexpr std::string_view kServerUnit = "server";
inline constexpr std::string_view kGatewayUnit = "gateway";

}  // namespace dripline::pki
