#include "clients/cli/accounts/account_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

Cell state_cell(const client::User& user) {
  return user.locked ? Cell("locked", Style::Bad) : Cell("active");
}

std::string when_text(const std::string& time) {
  return time.empty() ? "never" : time_text(time);
}

}  // namespace

const std::vector<std::string>& role_names() {
  static const std::vector<std::string> kRoles{"viewer", "operator", "programmer", "approver",
                                               "administrator"};
  return kRoles;
}

std::string names_text(const std::vector<std::string>& names) {
  return names.empty() ? "none" : printable(fmt::format("{}", fmt::join(names, ", ")));
}

std::string groups_text(const std::optional<std::vector<std::string>>& groups) {
  return groups ? names_text(*groups) : "as its user";
}

std::string expiry_text(const std::string& expires) {
  return when_text(expires);
}

std::string shortfall_text(const client::User& user) {
  if (user.groups.empty() && user.role != "viewer" && user.role != "administrator")
    return fmt::format("{} has no machine group, so may act on no machine", user.name);
  return {};
}

Details user_details(const client::User& user) {
  Details details;
  details.add("user", printable(user.name));
  details.add("role", printable(user.role));
  details.add("groups", user.role == "administrator" ? "all" : names_text(user.groups));
  details.add("state", state_cell(user));
  details.add("password", user.has_password ? "set" : "none");
  details.add("created", time_text(user.created));
  details.add("signed in", when_text(user.signed_in));
  return details;
}

Table user_table(const std::vector<client::User>& users) {
  Table table({"NAME", "ROLE", "GROUPS", "STATE", "PASSWORD", "SIGNED IN"});
  for (const auto& user : users) {
    table.add({printable(user.name), printable(user.role),
               user.role == "administrator" ? "all" : names_text(user.groups), state_cell(user),
               user.has_password ? "set" : "none", when_text(user.signed_in)});
  }
  return table;
}

Table token_table(const std::vector<client::Token>& tokens) {
  Table table({"NAME", "KIND", "ROLE", "GROUPS", "EXPIRES", "USED", "FROM"});
  for (const auto& token : tokens) {
    table.add({printable(token.name), printable(token.kind), printable(token.role),
               groups_text(token.groups), expiry_text(token.expires), when_text(token.used),
               printable(token.used_from)});
  }
  return table;
}

}  // namespace dripline::cli
