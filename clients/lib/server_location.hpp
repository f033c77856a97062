#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/base/private_folder.hpp"
#include "protocol/base/result.hpp"

namespace dripline::client {

/// The address of a server and the access to it.
struct ServerAddress {
  std::string url;    ///< http://HOST:PORT or https://HOST:PORT, no path, no slash at the end
  std::string token;  ///< empty: none; the server refuses the calls then
  std::optional<std::string> ca_file;  ///< https: PEM file of the authority to trust
  /// https: PEM files with the client's own certificate and its key; shown instead of a token.
  std::string certificate = {}, key = {};
};

/// What the user gave to find the server; everything is optional.
struct LocationOptions {
  std::optional<std::string> server;            ///< --server URL[,URL...]
  std::optional<std::string> token_file;        ///< --token-file FILE
  std::optional<std::string> ca_file;           ///< --ca FILE
  std::optional<std::string> state_dir;         ///< --state DIR
  std::optional<std::string> certificate = {};  ///< --cert FILE
  std::optional<std::string> key = {};          ///< --key FILE
};

/// Finds the server, or the servers of one library, in the order of their names: at least one, at
/// most kMaxServers. Addresses: --server, DRIPLINE_SERVER (both with commas between several), then
/// `url` of STATE/dncd.json, which a local server writes. Each has its own token: --token-file,
/// DRIPLINE_TOKEN (the token itself), then `token_file` of dncd.json; that last one is used only
/// for the server which dncd.json names, or when the state folder was named explicitly, so that the
/// local token is never sent elsewhere. A login that was saved for the address (saved_logins.hpp)
/// comes before the local token, unless --state is given. Without --token-file a certificate
/// (--cert, --key) is shown instead of a token. Errors: Syntax (an address or dncd.json that is not
/// as described; --cert without --key, or not for https), LimitExceeded (more servers), NotFound
/// (no server is named anywhere), Io (a file that cannot be read).
Result<std::vector<ServerAddress>> locate_servers(const LocationOptions& options,
                                                  const Environment& environment, bool is_root);
inline constexpr std::size_t kMaxServers = 8;

}  // namespace dripline::client
