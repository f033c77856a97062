#include "server/identity/permission.hpp"

#include <array>

namespace dripline::identity {
namespace {

struct PermissionRow {
  std::string_view name;
  std::optional<storage::Role> role;
};

using enum storage::Role;
constexpr std::array<PermissionRow, 8> kPermissions{{
    {"open", std::nullopt},
    {"signed_in", std::nullopt},
    {"view", Viewer},
    {"operate", Operator},
    {"program", Programmer},
    {"set_up", Programmer},
    {"approve", Approver},
    {"administer", Administrator},
}};

}  // namespace

std::string_view to_string(Permission permission) {
  return kPermissions.at(static_cast<std::size_t>(permission)).name;
}

std::optional<storage::Role> lowest_role(Permission permission) {
  return kPermissions.at(static_cast<std::size_t>(permission)).role;
}

}  // namespace dripline::identity
