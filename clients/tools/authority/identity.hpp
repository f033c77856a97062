#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::authority {

enum class Role { Server, Gateway };
/// "server", "gateway": also the organizational unit in certificates.
std::string_view to_string(Role role);

/// Whose a certificate is.
struct Holder {
  Role role = Role::Gateway;
  std::string name;  ///< of the machine; kServerName for the server
  friend auto operator<=>(const Holder&, const Holder&) = default;
};
inline constexpr const char* kServerName = "server";
inline Holder the_server() {
  return {Role::Server, kServerName};
}

/// Whole seconds.
struct Validity {
  UtcTime not_before, not_after;
};

/// One certificate that was issued.
struct Issued {
  Holder holder;
  std::string serial;  ///< hexadecimal digits
  Validity validity;
  std::optional<UtcTime> revoked = {};
};

/// The name of a shop, as certificates carry it: 1 to 64 letters, digits, blanks, `.`, `_` and `-`,
/// beginning and ending with a letter or digit. Errors: Syntax, LimitExceeded.
Result<void> check_shop_name(std::string_view name);

}  // namespace dripline::authority
