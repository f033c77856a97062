#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/cli/text/table.hpp"
#include "clients/lib/api_types.hpp"

/// How users and tokens look. Pure.
namespace dripline::cli {

/// Lowest first.
const std::vector<std::string>& role_names();
/// "lathes, mills", or "none".
std::string names_text(const std::vector<std::string>& names);
/// A token's groups: "as its user" when it has none of its own.
std::string groups_text(const std::optional<std::vector<std::string>>& groups);
/// Local time, or "never".
std::string expiry_text(const std::string& expires);
/// A remark where a user can do less than the role seems to promise; else empty.
std::string shortfall_text(const client::User& user);
Details user_details(const client::User& user);
Table user_table(const std::vector<client::User>& users);
Table token_table(const std::vector<client::Token>& tokens);

}  // namespace dripline::cli
