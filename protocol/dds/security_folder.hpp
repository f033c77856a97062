#pragma once

#include <filesystem>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/configuration.hpp"
#include "protocol/pki/certificate.hpp"

namespace dripline::dds {

/// What one computer has for DDS Security: the folder that `dnc pki` made for it.
struct SecurityFolder {
  SecurityFiles files;
  pki::Certificate certificate;  ///< its own
};

/// Whose the folder must be.
struct SecurityHolder {
  Role role = Role::Gateway;
  std::string machine = {};  ///< of a gateway
};

/// Reads and verifies the folder, because DDS itself would only report "error", or never match:
/// every file is there, only its owner and group can read the key, the key is the certificate's,
/// the authority signed certificate, permissions and governance, the certificate is valid at `now`,
/// not revoked and the holder's, and so are the permissions. Errors name file and reason: NotFound,
/// LimitExceeded, Io, Syntax, Denied.
Result<SecurityFolder> open_security_folder(const std::filesystem::path& folder,
                                            const SecurityHolder& holder, UtcTime now);

}  // namespace dripline::dds
