#include "server/app/state_folder.hpp"

#include <sys/stat.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "protocol/base/durable_file.hpp"
#include "protocol/base/private_folder.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"
#include "storage/migration/files.hpp"

namespace dripline::app {
namespace {

constexpr std::size_t kSecretBytes = 32;

tl::unexpected<Error> fail_with_errno(const std::filesystem::path& path) {
  return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
}

Result<void> replace_file(const std::filesystem::path& path, const std::string& text) {
  if (replace_private_file(path, text)) return {};
  return fail_with_errno(path);
}

/// The first line of a file that only its owner can read; made of random digits when it is missing.
Result<std::string> secret_in(const std::filesystem::path& path, std::string_view remedy) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) {
    if (auto made = replace_file(path, random_hex(kSecretBytes) + "\n"); !made)
      return fail(made.error());
    if (::stat(path.c_str(), &facts) != 0) return fail_with_errno(path);
  }
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return fail(Errc::Denied, "{} can be read by others: chmod 600 it{}", path.string(), remedy);
  }
  std::ifstream file(path);
  std::string secret;
  std::getline(file, secret);
  return secret;
}

}  // namespace

Result<StateFolder> StateFolder::open(const std::string& path) {
  // `dnc pki init` may have been here before the server.
  const auto closed = make_private_folder(
      path, {kDatabase, kSigningKey, kIdentity, kServer, kLock, "pki/authority"});
  if (!closed) return fail(closed.error().code, "state {}", closed.error().what);
  if (!closed->empty()) process::log_warning("state {}", *closed);
  return StateFolder(std::filesystem::absolute(path));
}

Result<std::string> StateFolder::token() const {
  auto token = secret_in(token_file(), ", or remove it for a new one");
  constexpr std::size_t kShortest = 32;
  if (!token || token->size() >= kShortest) return token;
  return fail(Errc::Denied, "{} holds a token of {} characters: at least {}", token_file().string(),
              token->size(), kShortest);
}

Result<std::string> StateFolder::signing_seed() const {
  // Without it no decision that was signed before verifies: it is to be restored from a backup.
  return secret_in(signing_file(), "");
}

Result<void> StateFolder::expect_database(bool begin_empty) const {
  std::error_code ec;
  const auto size = std::filesystem::file_size(database(), ec);
  const bool is_there = !ec && size > 0;
  if (begin_empty) {
    if (is_there) {
      return fail(Errc::Busy, "--begin-empty: {} is there; start without it", database().string());
    }
    // What is left of the lost one must not be taken for the new one's.
    for (const char* suffix : {"", "-wal", "-shm"})
      std::filesystem::remove(database().string() + suffix, ec);
    std::filesystem::remove(identity_file(), ec);
    return {};
  }
  if (is_there) return {};
  if (const auto entered = migration::entered_file(database());
      std::filesystem::exists(entered, ec)) {
    return fail(
        Errc::Conflict,
        "{} is of a migration into this folder that was ended before its last step: run the "
        "migration again (dnc server migrate --from URL --to {}), or go on with the "
        "PostgreSQL database by --store",
        entered.string(), path_.string());
  }
  const auto left = migration::left_file(database());
  if (std::filesystem::exists(left, ec)) {
    return fail(Errc::Conflict,
                "what this folder kept was migrated to a PostgreSQL database: name it with --store "
                "(`store` in dncd.toml). {} is how it was then",
                left.string());
  }
  if (!std::filesystem::exists(identity_file(), ec)) return {};
  return fail(Errc::Corrupt,
              "the database of this folder, {}, is {}: restore it from a backup, or start once "
              "with --begin-empty to begin without programs, runs and reports",
              database().string(), size == 0 ? "empty" : "missing");
}

Result<FileLock> StateFolder::lock() const {
  return FileLock::acquire(path_ / kLock, path_.string());
}

Result<std::string> StateFolder::server_id() const {
  return secret_in(path_ / kServer, "");
}

Result<std::uint64_t> StateFolder::term() const {
  const auto path = path_ / kTerm;
  std::error_code ec;
  if (!std::filesystem::exists(path, ec)) return std::uint64_t{0};
  std::uint64_t term = 0;
  if (std::ifstream(path) >> term) return term;
  return fail(Errc::Corrupt,
              "{} holds no number: remove it, and restart the gateways, which listen to no server "
              "of a lower term than they have seen",
              path.string());
}

Result<void> StateFolder::remember_term(std::uint64_t term) const {
  return replace_file(path_ / kTerm, std::to_string(term) + "\n");
}

Result<void> StateFolder::remember_database(const std::string& identity,
                                            const std::string& name) const {
  std::error_code ec;
  if (!std::filesystem::exists(identity_file(), ec))
    return replace_file(identity_file(), identity + "\n");
  return expect_identity(identity, name);
}

Result<void> StateFolder::expect_identity(const std::string& identity,
                                          const std::string& name) const {
  std::error_code ec;
  if (!std::filesystem::exists(identity_file(), ec)) {
    return fail(Errc::NotFound,
                "{}: this state folder has not been its server's, {} is missing: use the folder "
                "that has the key of its audit trail",
                name, identity_file().string());
  }
  std::ifstream file(identity_file());
  std::string known;
  std::getline(file, known);
  if (known == identity) return {};
  return fail(Errc::Corrupt,
              "{} is not the database this folder has had ({}, expected {}): put the right one "
              "back, or remove {} to continue with this one",
              name, identity, known, identity_file().string());
}

Result<void> StateFolder::announce(const Announcement& announcement) const {
  const nlohmann::json json{
      {"url", announcement.url},
      {"pid", ::getpid()},
      {"token_file", token_file().string()},
      {"dds", {{"domain", announcement.dds_domain}, {"tag", announcement.dds_tag}}}};
  return replace_file(announcement_file(), json.dump() + "\n");
}

void StateFolder::withdraw() const {
  std::error_code ec;
  std::filesystem::remove(announcement_file(), ec);
}

}  // namespace dripline::app
