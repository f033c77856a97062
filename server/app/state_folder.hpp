#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "protocol/base/result.hpp"

namespace dripline::app {

/// The server's folder: the database, the token, and dncd.json while it listens, so that `dnc`
/// finds a server of this machine without being told.
class StateFolder {
 public:
  /// Makes the folder when it is missing, for its owner alone; closes it to others. Errors: Io,
  /// Denied.
  static Result<StateFolder> open(const std::string& path);

  /// The bearer token; made of random bytes at the first start, readable by the owner alone.
  /// Errors: Io, Denied (others may read or change it).
  Result<std::string> token() const;

  struct Announcement {
    std::string url;
    std::uint32_t dds_domain = 0;
    std::string dds_tag;
  };
  /// Writes dncd.json, whole or not at all.
  Result<void> announce(const Announcement& announcement) const;
  void withdraw() const;

  std::filesystem::path database() const { return path_ / "dripline.sqlite"; }
  /// What passed over serial lines last.
  std::filesystem::path recordings() const { return path_ / "recordings"; }
  std::filesystem::path token_file() const { return path_ / "token"; }
  const std::filesystem::path& path() const { return path_; }

 private:
  explicit StateFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path announcement_file() const { return path_ / "dncd.json"; }
  Result<void> make_token() const;

  std::filesystem::path path_;
};

}  // namespace dripline::app
