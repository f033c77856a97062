#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "clients/lib/server_address.hpp"
#include "protocol/base/result.hpp"

namespace dripline::client {

/// What the user said about where the server is; everything is optional.
struct LocationOptions {
  std::optional<std::string> server;      ///< --server URL
  std::optional<std::string> token_file;  ///< --token-file FILE
  std::optional<std::string> ca_file;     ///< --ca FILE
  std::optional<std::string> state_dir;   ///< --state DIR
};

/// The environment comes in through this, so that tests own it; nullopt for an unset or empty
/// variable.
using Environment = std::function<std::optional<std::string>(std::string_view name)>;
std::optional<std::string> process_environment(std::string_view name);

/// The folder where a server started by this user keeps its state: --state, DRIPLINE_STATE, then
/// /var/lib/dripline for root, then XDG_STATE_HOME/dripline, then ~/.local/state/dripline.
/// Errors: NotFound (none of them says anything).
Result<std::string> state_directory(const LocationOptions& options, const Environment& environment,
                                    bool is_root);

/// Finds the server. Address: --server, DRIPLINE_SERVER, then `url` of STATE/dncd.json, which a
/// local server writes. Token: --token-file, DRIPLINE_TOKEN (the token itself), then `token_file`
/// of dncd.json; that last one is used only for the server which dncd.json names, or when the state
/// folder was named explicitly, so that the local token is never sent elsewhere.
/// Errors: Syntax (an address or dncd.json that is not as described), NotFound (no server is named
/// anywhere), Io (a file that can not be read).
Result<ServerAddress> locate_server(const LocationOptions& options, const Environment& environment,
                                    bool is_root);

}  // namespace dripline::client
