#include "storage/account_store.hpp"

#include <array>

namespace dripline::storage {
namespace {

constexpr std::array<std::string_view, 5> kRoles{"viewer", "operator", "programmer", "approver",
                                                 "administrator"};
constexpr std::array<std::string_view, 3> kUserStates{"active", "locked", "removed"};
constexpr std::array<std::string_view, 3> kCredentialKinds{"token", "login", "page"};

}  // namespace

std::string_view to_string(Role role) {
  return kRoles.at(static_cast<std::size_t>(role));
}

Result<Role> parse_role(std::string_view name) {
  for (std::size_t at = 0; at < kRoles.size(); ++at) {
    if (kRoles.at(at) == name) return static_cast<Role>(at);
  }
  return fail(Errc::Unsupported,
              "role '{}' is not known; known are: viewer, operator, programmer, approver, "
              "administrator",
              name);
}

std::string_view to_string(UserState state) {
  return kUserStates.at(static_cast<std::size_t>(state));
}

std::string_view to_string(CredentialKind kind) {
  return kCredentialKinds.at(static_cast<std::size_t>(kind));
}

}  // namespace dripline::storage
