#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "storage/account_store.hpp"

namespace dripline::identity {

/// What a request may do. Each has a lowest role, but Open, which anybody may, and SignedIn, which
/// every caller may.
enum class Permission : std::uint8_t {
  Open,
  SignedIn,    ///< what concerns the caller alone: its session, its password, its tokens
  View,        ///< read programs, machines, runs, reports
  Operate,     ///< start, hold, answer: on machines of the caller's groups
  Program,     ///< push, copy, rename, remove
  SetUp,       ///< change what a control knows before a program starts: as Operate
  Approve,     ///< accept and reject what machines sent; read the audit trail
  Administer,  ///< users, groups, ports
};

/// The word for it, in openapi.json and in refusals.
std::string_view to_string(Permission permission);
/// Absent: Open and SignedIn.
std::optional<storage::Role> lowest_role(Permission permission);

}  // namespace dripline::identity
