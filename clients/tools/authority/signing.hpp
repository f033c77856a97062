#pragma once

#include <string>
#include <vector>

#include "clients/tools/authority/identity.hpp"

/// Keys, certificates and signed documents, with OpenSSL's library; everything is PEM, documents
/// are S/MIME. Keys are P-256, the only curve that Cyclone DDS takes. Errors: Io (OpenSSL's).
namespace dripline::authority {

Result<std::string> make_key();

/// Hexadecimal digits of a random number.
std::string new_serial();

/// What a certificate is for. One of them never serves for another.
enum class Purpose {
  IdentityAuthority,     ///< signs certificates and the list of revoked ones
  PermissionsAuthority,  ///< signs permissions and governance, no certificates
  Identity,              ///< of a server or a gateway
};

struct Request {
  Purpose purpose = Purpose::Identity;
  std::string shop, unit, name;  ///< O, OU and CN; checked names
  std::string serial;
  Validity validity;
};

/// A certificate with its private key.
struct Signer {
  std::string certificate, key;
};

/// Signed by its own key.
Result<std::string> make_root(const Request& request, const std::string& key);
/// For the public half of `key`, signed by `signer`.
Result<std::string> make_certificate(const Request& request, const std::string& key,
                                     const Signer& signer);
/// The certificates of `issued` that were revoked. It never expires before its signer: an expired
/// one would lock everybody out.
Result<std::string> make_revocation_list(const std::vector<Issued>& issued, const Signer& signer,
                                         UtcTime now);
Result<std::string> sign_document(const std::string& text, const Signer& signer);

/// Clocks of a shop differ: what is made now is valid since a day ago.
inline constexpr std::chrono::hours kClockTolerance{24};

}  // namespace dripline::authority
