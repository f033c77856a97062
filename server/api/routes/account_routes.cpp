#include <nlohmann/json.hpp>

#include "server/api/access_control.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/account_bodies.hpp"
#include "server/api/nullable_json.hpp"

namespace dripline::api {
namespace {

using identity::Caller;
using identity::Credential;
using nlohmann::json;

json user_json(const identity::User& user) {
  return {{"name", user.name},
          {"role", storage::to_string(user.role)},
          {"groups", user.groups},
          {"locked", user.state == identity::UserState::Locked},
          {"has_password", !user.password.empty()},
          {"created", to_iso8601(user.created)},
          {"signed_in", time_or_null(user.signed_in)}};
}

/// The role is the one that it has now, with its user's.
json token_json(const Credential& token, identity::Role users_role) {
  return {{"user", token.user},
          {"name", token.name},
          {"kind", storage::to_string(token.kind)},
          {"role", storage::to_string(std::min(token.role, users_role))},
          {"groups", token.groups ? json(*token.groups) : json(nullptr)},
          {"created", to_iso8601(token.created)},
          {"expires", time_or_null(token.expires)},
          {"used", time_or_null(token.used)},
          {"used_from", text_or_null(token.used_from)}};
}

json group_json(const identity::MachineGroup& group) {
  return {{"name", group.name}, {"machines", group.machines}};
}

json session_json(const Services& services, const Caller& caller) {
  return {{"user", caller.user},
          {"role", storage::to_string(caller.role)},
          {"groups", services.accounts.groups_of(caller)},
          {"credential", caller.credential},
          {"kind", storage::to_string(caller.kind)},
          {"expires", time_or_null(caller.expires)},
          {"address", caller.address}};
}

/// The caller is known here, so what it may not do is 403 and not 401.
Response refused(const Error& error) {
  return error.code == Errc::Denied ? forbidden(error.what) : error_response(error);
}
template <class T>
Response refused_or(const Result<T>& done, int status, const std::function<json(const T&)>& view) {
  return done ? json_response(status, view(*done)) : refused(done.error());
}
Response refused_or_empty(const Result<void>& done) {
  return done ? no_content() : refused(done.error());
}

/// A handler that takes no query.
Handler of_accounts(Services& services, Response (*handler)(Services&, const Request&)) {
  return [&services, handler](const Request& request) {
    QueryReader query(request);
    if (auto good = query.finish(); !good) return error_response(good.error());
    return handler(services, request);
  };
}

// -- session --------------------------------------------------------------------------------------

Response refused_sign_in(const Error& error) {
  constexpr int kTooMany = 429;
  if (error.code != Errc::Busy) return error_response(error);
  Response response = error_response(kTooMany, error);
  response.headers.emplace_back("Retry-After", "30");
  return response;
}

Response sign_in(Services& services, const Request& request) {
  auto wanted = decode_sign_in(request.body);
  if (!wanted) return error_response(wanted.error());
  const bool is_page = wanted->kind == identity::CredentialKind::Page;
  if (is_page && request.header(AccessControl::kPageHeader).empty()) {
    return forbidden(
        "a sign-in for a cookie has the header field X-Dripline; \"bearer\": true asks for a "
        "token");
  }
  wanted->address = request.address;
  const auto issued = services.accounts.sessions().sign_in(*wanted);
  if (!issued) return refused_sign_in(issued.error());
  using identity::PresentedSecret;
  const auto from = is_page ? PresentedSecret::From::Cookie : PresentedSecret::From::Bearer;
  const auto caller = services.accounts.find({from, issued->secret}, request.address);
  if (!caller) return error_response({Errc::Denied, "the session has ended already"});
  json view = session_json(services, *caller);
  if (!is_page) view["secret"] = issued->secret;
  Response response = json_response(201, view);
  if (is_page) {
    response.headers.emplace_back("Set-Cookie",
                                  identity::set_cookie(issued->secret, services.has_tls));
  }
  return response;
}

Response show_session(Services& services, const Request& request) {
  return json_response(200, session_json(services, *request.caller));
}

Response sign_out(Services& services, const Request& request) {
  Response response = refused_or_empty(services.accounts.sessions().sign_out(*request.caller));
  if (request.caller->kind == identity::CredentialKind::Page)
    response.headers.emplace_back("Set-Cookie", identity::clear_cookie(services.has_tls));
  return response;
}

// -- users ----------------------------------------------------------------------------------------

Response list_users(Services& services, const Request&) {
  auto list = json::array();
  for (const auto& user : services.accounts.users().list()) list.push_back(user_json(user));
  return json_response(200, {{"users", std::move(list)}});
}

Response add_user(Services& services, const Request& request) {
  const auto user = decode_user(request.body);
  if (!user) return error_response(user.error());
  return refused_or<identity::User>(services.accounts.users().add(*request.caller, *user), 201,
                                    user_json);
}

Response show_user(Services& services, const Request& request) {
  return refused_or<identity::User>(
      services.accounts.users().find(*request.caller, request.parameter("name")), 200, user_json);
}

Response change_user(Services& services, const Request& request) {
  const auto change = decode_user_change(request.body);
  if (!change) return error_response(change.error());
  return refused_or<identity::User>(
      services.accounts.users().change(*request.caller, request.parameter("name"), *change), 200,
      user_json);
}

Response set_password(Services& services, const Request& request) {
  const auto password = decode_password(request.body);
  if (!password) return error_response(password.error());
  return refused_or_empty(services.accounts.users().set_password(
      *request.caller, request.parameter("name"), *password));
}

Response remove_user(Services& services, const Request& request) {
  return refused_or_empty(
      services.accounts.users().remove(*request.caller, request.parameter("name")));
}

// -- tokens ---------------------------------------------------------------------------------------

Response list_tokens(Services& services, const Request& request) {
  const auto user = services.accounts.users().find(*request.caller, request.parameter("name"));
  if (!user) return refused(user.error());
  const auto tokens = services.accounts.tokens().list(*request.caller, user->name);
  if (!tokens) return refused(tokens.error());
  auto list = json::array();
  for (const auto& token : *tokens) list.push_back(token_json(token, user->role));
  return json_response(200, {{"tokens", std::move(list)}});
}

Response add_token(Services& services, const Request& request) {
  const auto wanted = decode_token(request.body);
  if (!wanted) return error_response(wanted.error());
  const auto issued =
      services.accounts.tokens().add(*request.caller, request.parameter("name"), *wanted);
  if (!issued) return refused(issued.error());
  json view = token_json(issued->credential, issued->credential.role);
  view["secret"] = issued->secret;
  return json_response(201, view);
}

Response revoke_token(Services& services, const Request& request) {
  return refused_or_empty(services.accounts.tokens().revoke(
      *request.caller, request.parameter("name"), request.parameter("token")));
}

// -- groups ---------------------------------------------------------------------------------------

Response list_groups(Services& services, const Request&) {
  auto list = json::array();
  for (const auto& group : services.accounts.groups().list()) list.push_back(group_json(group));
  return json_response(200, {{"groups", std::move(list)}});
}

Response save_group(Services& services, const Request& request) {
  const auto saved = services.accounts.groups().add(*request.caller, request.parameter("group"));
  if (!saved) return refused(saved.error());
  return json_response(saved->is_new ? 201 : 200, group_json(saved->group));
}

Response remove_group(Services& services, const Request& request) {
  return refused_or_empty(
      services.accounts.groups().remove(*request.caller, request.parameter("group")));
}

Response add_machine(Services& services, const Request& request) {
  return refused_or<identity::MachineGroup>(
      services.accounts.groups().add_machine(*request.caller, request.parameter("group"),
                                             request.parameter("machine")),
      200, group_json);
}

Response remove_machine(Services& services, const Request& request) {
  return refused_or<identity::MachineGroup>(
      services.accounts.groups().remove_machine(*request.caller, request.parameter("group"),
                                                request.parameter("machine")),
      200, group_json);
}

}  // namespace

void add_account_routes(Router& router, Services& services) {
  const std::string session = "/api/v1/session";
  router.add("POST", session, of_accounts(services, sign_in));
  router.add("GET", session, of_accounts(services, show_session));
  router.add("DELETE", session, of_accounts(services, sign_out));
  const std::string user = "/api/v1/users/{name}";
  router.add("GET", "/api/v1/users", of_accounts(services, list_users));
  router.add("POST", "/api/v1/users", of_accounts(services, add_user));
  router.add("GET", user, of_accounts(services, show_user));
  router.add("PUT", user, of_accounts(services, change_user));
  router.add("DELETE", user, of_accounts(services, remove_user));
  router.add("PUT", user + "/password", of_accounts(services, set_password));
  router.add("GET", user + "/tokens", of_accounts(services, list_tokens));
  router.add("POST", user + "/tokens", of_accounts(services, add_token));
  router.add("DELETE", user + "/tokens/{token}", of_accounts(services, revoke_token));
  const std::string group = "/api/v1/machine-groups/{group}";
  router.add("GET", "/api/v1/machine-groups", of_accounts(services, list_groups));
  router.add("PUT", group, of_accounts(services, save_group));
  router.add("DELETE", group, of_accounts(services, remove_group));
  router.add("PUT", group + "/machines/{machine}", of_accounts(services, add_machine));
  router.add("DELETE", group + "/machines/{machine}", of_accounts(services, remove_machine));
}

}  // namespace dripline::api
