#pragma once

#include <string>
#include <utility>

namespace dripline::storage {

/// Who causes a change: a user, by which credential and from which address, or a machine.
struct Actor {
  Actor() = default;
  // Implicit: a machine, and the server itself, have a name alone.
  Actor(const char* who) : name(who) {}
  Actor(std::string who, std::string with = {}, std::string from = {})
      : name(std::move(who)), credential(std::move(with)), address(std::move(from)) {}

  std::string name;
  std::string credential;  ///< the name of the user's token or session
  std::string address;     ///< of the client
};

}  // namespace dripline::storage
