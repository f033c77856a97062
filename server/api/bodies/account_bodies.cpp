#include "server/api/bodies/account_bodies.hpp"

#include "server/api/bodies/json_object.hpp"
#include "server/identity/account_limits.hpp"

namespace dripline::api {
namespace {

using Limits = identity::AccountLimits;

constexpr std::size_t kMaxAccountName = 256;  ///< longer ones are refused before they are checked

/// Absent: nullopt, and an empty list is one.
std::optional<std::set<std::string>> read_groups(JsonObject& object) {
  const bool is_given = object.has("groups");
  const auto names = object.optional_texts("groups", kMaxAccountName, Limits::kMaxGroups);
  if (!is_given) return std::nullopt;
  return std::set<std::string>(names.begin(), names.end());
}

Result<std::optional<storage::Role>> read_role(JsonObject& object) {
  const auto name = object.optional_text("role", kMaxAccountName);
  if (!name) return std::optional<storage::Role>();
  const auto role = storage::parse_role(*name);
  if (!role) return fail(role.error());
  return std::optional(*role);
}

/// `shortest` to `longest`.
template <class Time>
Result<Time> read_time(JsonObject& object, const std::string& name, Time usual, Time longest) {
  const auto number = object.optional_unsigned(name);
  if (!number) return usual;
  const auto most = static_cast<std::uint64_t>(longest.count());
  if (*number >= 1 && *number <= most) return Time(static_cast<int>(*number));
  return fail(Errc::LimitExceeded, "member '{}' is {}: 1 to {}", name, *number, most);
}

}  // namespace

Result<identity::SignIn> decode_sign_in(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  identity::SignIn request;
  request.user = object->required_text("user", kMaxAccountName);
  request.password = object->required_text("password", Limits::kMaxPassword);
  const bool is_bearer = object->optional_flag("bearer").value_or(false);
  request.kind = is_bearer ? identity::CredentialKind::Login : identity::CredentialKind::Page;
  const auto life = read_time(*object, "hours", request.life, Limits::kMaxSessionLife);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!life) return fail(life.error());
  request.life = *life;
  return request;
}

Result<identity::NewUser> decode_user(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  identity::NewUser user;
  user.name = object->required_text("name", kMaxAccountName);
  const auto role = read_role(*object);
  user.groups = read_groups(*object).value_or(std::set<std::string>());
  user.password = object->optional_text("password", Limits::kMaxPassword);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!role) return fail(role.error());
  if (!*role) return fail(Errc::Syntax, "member 'role' is missing: a string");
  user.role = **role;
  return user;
}

Result<identity::UserChange> decode_user_change(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  identity::UserChange change;
  const auto role = read_role(*object);
  change.groups = read_groups(*object);
  change.is_locked = object->optional_flag("locked");
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!role) return fail(role.error());
  change.role = *role;
  return change;
}

Result<identity::NewPassword> decode_password(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  identity::NewPassword password;
  password.password = object->required_text("password", Limits::kMaxPassword);
  password.current = object->optional_text("current", Limits::kMaxPassword).value_or("");
  if (auto good = object->finish(); !good) return fail(good.error());
  return password;
}

Result<identity::NewToken> decode_token(std::string_view body) {
  auto object = JsonObject::parse(body);
  if (!object) return fail(object.error());
  identity::NewToken token;
  token.name = object->required_text("name", kMaxAccountName);
  const auto role = read_role(*object);
  token.groups = read_groups(*object);
  const auto life = read_time(*object, "days", token.life, Limits::kMaxTokenLife);
  if (auto good = object->finish(); !good) return fail(good.error());
  if (!role) return fail(role.error());
  if (!life) return fail(life.error());
  token.role = *role;
  token.life = *life;
  return token;
}

}  // namespace dripline::api
