#pragma once

#include <optional>
#include <string>

namespace dripline::client {

/// Where a server is and how to be let in.
struct ServerAddress {
  std::string url;    ///< http://HOST:PORT or https://HOST:PORT, no path, no slash at the end
  std::string token;  ///< empty: none known, and the server will say so
  std::optional<std::string> ca_file;  ///< https: PEM file of the authority to trust
};

}  // namespace dripline::client
