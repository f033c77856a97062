#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "protocol/base/private_folder.hpp"
#include "protocol/base/result.hpp"

namespace dripline::client {

/// What `dnc login` keeps between calls: the secret of a session for each server, in a file that
/// its owner alone can read. Errors of everything: Io, Syntax (the file is none of ours), Denied
/// (others can read it).
class SavedLogins {
 public:
  explicit SavedLogins(std::filesystem::path file) : file_(std::move(file)) {}

  /// nullopt: none for this address, or it has expired.
  Result<std::optional<std::string>> find(const std::string& url) const;
  /// Replaces the one for this address. `expires` is ISO 8601 UTC.
  Result<void> save(const std::string& url, const std::string& secret,
                    const std::string& expires) const;
  Result<void> remove(const std::string& url) const;

 private:
  std::filesystem::path file_;
};

/// $XDG_CONFIG_HOME/dripline/logins.json, else ~/.config/dripline/logins.json; nullopt without a
/// home.
std::optional<std::filesystem::path> login_file(const Environment& environment);

}  // namespace dripline::client
