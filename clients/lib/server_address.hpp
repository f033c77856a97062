#pragma once

#include <optional>
#include <string>

namespace dripline::client {

/// The address of a server and the access to it.
struct ServerAddress {
  std::string url;    ///< http://HOST:PORT or https://HOST:PORT, no path, no slash at the end
  std::string token;  ///< empty: none; the server refuses the calls then
  std::optional<std::string> ca_file;  ///< https: PEM file of the authority to trust
};

}  // namespace dripline::client
