// The calls of Client for users, tokens and groups of machines.
#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::dumped;
using impl::get;
using impl::path_of;
using impl::with_method;

namespace {

std::string token_path(std::string_view user, std::string_view token) {
  return fmt::format("{}/tokens/{}", path_of("users", user), url_encode(token));
}

std::string member_path(std::string_view group, std::string_view machine) {
  return fmt::format("{}/machines/{}", path_of("machine-groups", group), url_encode(machine));
}

}  // namespace

Reply<Session> Client::sign_in(const SignInRequest& request) {
  return fetch<Session>(with_method("POST", path_of("session")),
                        dumped({{"user", request.user},
                                {"password", request.password},
                                {"bearer", true},
                                {"hours", request.hours}}));
}

Reply<Session> Client::session() {
  return fetch<Session>(get(path_of("session")));
}

Reply<void> Client::sign_out() {
  return perform(with_method("DELETE", path_of("session")));
}

Reply<std::vector<User>> Client::users() {
  return fetch_list<User>(path_of("users"), "users");
}

Reply<User> Client::user(std::string_view name) {
  return fetch<User>(get(path_of("users", name)));
}

Reply<User> Client::add_user(const UserRequest& request) {
  nlohmann::json body{{"name", request.name}, {"role", request.role}, {"groups", request.groups}};
  if (request.password) body["password"] = *request.password;
  return fetch<User>(with_method("POST", path_of("users")), dumped(body));
}

Reply<User> Client::change_user(std::string_view name, const UserChange& change) {
  auto body = nlohmann::json::object();
  if (change.role) body["role"] = *change.role;
  if (change.groups) body["groups"] = *change.groups;
  if (change.locked) body["locked"] = *change.locked;
  return fetch<User>(with_method("PUT", path_of("users", name)), dumped(body));
}

Reply<void> Client::set_password(std::string_view name, const std::string& password,
                                 const std::string& current) {
  nlohmann::json body{{"password", password}};
  if (!current.empty()) body["current"] = current;
  return perform(with_method("PUT", path_of("users", name) + "/password"), dumped(body));
}

Reply<void> Client::remove_user(std::string_view name) {
  return perform(with_method("DELETE", path_of("users", name)));
}

Reply<std::vector<Token>> Client::tokens(std::string_view user) {
  return fetch_list<Token>(path_of("users", user) + "/tokens", "tokens");
}

Reply<Token> Client::add_token(const TokenRequest& request) {
  nlohmann::json body{{"name", request.name}, {"days", request.days}};
  if (request.role) body["role"] = *request.role;
  if (request.groups) body["groups"] = *request.groups;
  return fetch<Token>(with_method("POST", path_of("users", request.user) + "/tokens"),
                      dumped(body));
}

Reply<void> Client::revoke_token(std::string_view user, std::string_view name) {
  return perform(with_method("DELETE", token_path(user, name)));
}

Reply<std::vector<MachineGroup>> Client::machine_groups() {
  return fetch_list<MachineGroup>(path_of("machine-groups"), "groups");
}

Reply<MachineGroup> Client::add_group(std::string_view name) {
  return fetch<MachineGroup>(with_method("PUT", path_of("machine-groups", name)));
}

Reply<void> Client::remove_group(std::string_view name) {
  return perform(with_method("DELETE", path_of("machine-groups", name)));
}

Reply<MachineGroup> Client::add_to_group(std::string_view group, std::string_view machine) {
  return fetch<MachineGroup>(with_method("PUT", member_path(group, machine)));
}

Reply<MachineGroup> Client::remove_from_group(std::string_view group, std::string_view machine) {
  return fetch<MachineGroup>(with_method("DELETE", member_path(group, machine)));
}

}  // namespace dripline::client
