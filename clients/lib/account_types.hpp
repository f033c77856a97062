#pragma once

#include <optional>
#include <string>
#include <vector>

/// The part of api_types.hpp, which has the rules for all, about users, their tokens and groups.
namespace dripline::client {

/// Who the caller is, and by which token or session.
struct Session {
  std::string user, role;
  std::vector<std::string> groups;
  std::string credential, kind, expires, address;
  std::string secret;  ///< of a new one alone
};

struct User {
  std::string name, role;
  std::vector<std::string> groups;
  bool locked = false, has_password = false;
  std::string created, signed_in;
};

/// A token or a session of a user.
struct Token {
  std::string user, name, kind, role;
  std::optional<std::vector<std::string>> groups;  ///< nullopt: those of its user
  std::string created, expires, used, used_from;
  std::string secret;  ///< of a new one alone
};

struct MachineGroup {
  std::string name;
  std::vector<std::string> machines;
};

}  // namespace dripline::client
