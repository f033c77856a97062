#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::app {

/// The server's folder: the database, the token, and dncd.json while it listens, so that `dnc`
/// finds a server of this machine by itself.
class StateFolder {
 public:
  /// Makes the folder when it is missing, for its owner alone; closes it to others. Errors: Io,
  /// Denied.
  static Result<StateFolder> open(const std::string& path);

  /// The bearer token; made of random bytes at the first start, readable by the owner alone.
  /// Errors: Io, Denied (others may read or change it).
  Result<std::string> token() const;

  /// The seed of the key that decisions are signed with; made like the token. Errors: those of
  /// `token`.
  Result<std::string> signing_seed() const;

  /// Before the database is opened: one that this folder has had must be there. `begin_empty`: it
  /// is known to be lost, and a new one is wanted. Errors: Corrupt (missing or empty), Busy
  /// (wanted, but it is there), Io.
  Result<void> expect_database(bool begin_empty) const;
  /// After it was opened; `name`: for people. Errors: Corrupt (it is not the one this folder has
  /// had), Io.
  Result<void> remember_database(const std::string& identity, const std::string& name) const;

  /// The same without remembering it: one that this folder has had. Errors: also NotFound (it has
  /// had none).
  Result<void> expect_identity(const std::string& identity, const std::string& name) const;

  /// Of a database that was moved here from servers that had terms (storage::OpenedStore::term):
  /// one above all of them, for the gateways that have seen those. 0: none was. Errors: Io,
  /// Corrupt.
  Result<std::uint64_t> term() const;
  Result<void> remember_term(std::uint64_t term) const;

  /// One process uses a database elsewhere with this folder. Errors: Busy, Io.
  Result<FileLock> lock() const;
  /// What this folder's server calls itself in a database elsewhere; made like the token.
  Result<std::string> server_id() const;

  struct Announcement {
    std::string url;
    std::uint32_t dds_domain = 0;
    std::string dds_tag;
  };
  /// Writes dncd.json, whole or not at all.
  Result<void> announce(const Announcement& announcement) const;
  void withdraw() const;

  static constexpr const char* kDatabase = "dripline.sqlite";

  std::filesystem::path database() const { return path_ / kDatabase; }
  /// What a backup holds beside the database.
  static std::vector<std::string> files() { return {kToken, kIdentity, kSigningKey, kTerm}; }
  /// What passed over serial lines last.
  std::filesystem::path recordings() const { return path_ / "recordings"; }
  /// Audit entries that the database does not have yet (library::WaitingEntries).
  std::filesystem::path waiting_entries() const { return path_ / "audit-waiting"; }
  /// Program text of a database elsewhere; it may be removed at any time.
  std::filesystem::path cache() const { return path_ / "cache"; }
  std::filesystem::path token_file() const { return path_ / kToken; }
  /// The identity of the database that belongs here.
  std::filesystem::path identity_file() const { return path_ / kIdentity; }
  /// Whoever has it can sign as this server.
  std::filesystem::path signing_file() const { return path_ / kSigningKey; }
  const std::filesystem::path& path() const { return path_; }

 private:
  static constexpr const char* kToken = "token";
  static constexpr const char* kIdentity = "database.id";
  static constexpr const char* kServer = "server.id";
  static constexpr const char* kTerm = "term";
  static constexpr const char* kLock = "server.lock";
  static constexpr const char* kSigningKey = "signing.key";
  explicit StateFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path announcement_file() const { return path_ / "dncd.json"; }

  std::filesystem::path path_;
};

}  // namespace dripline::app
