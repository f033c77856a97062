#include "clients/lib/saved_logins.hpp"

#include <sys/stat.h>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "protocol/base/clock.hpp"
#include "protocol/base/durable_file.hpp"

namespace dripline::client {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uintmax_t kMaxFile = 1 << 20;

tl::unexpected<Error> failed_with_errno(const fs::path& path) {
  return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
}

/// `{URL: {"secret", "expires"}}`; empty when there is no file.
Result<Json> read_logins(const fs::path& path) {
  struct stat facts {};
  if (::stat(path.c_str(), &facts) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return Json::object();
    return failed_with_errno(path);
  }
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return fail(Errc::Denied, "{} can be read by others: chmod 600 it, or remove it",
                path.string());
  if (static_cast<std::uintmax_t>(facts.st_size) > kMaxFile)
    return fail(Errc::Syntax, "{} has {} bytes: at most {}", path.string(), facts.st_size,
                kMaxFile);
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(Errc::Io, "{} cannot be read", path.string());
  const std::string text(std::istreambuf_iterator<char>(file), {});
  auto logins = Json::parse(text, nullptr, false);
  if (!logins.is_object())
    return fail(Errc::Syntax, "{} holds no logins: remove it and log in again", path.string());
  return logins;
}

/// The whole file or none of it, for its owner alone.
Result<void> write_logins(const fs::path& path, const Json& logins) {
  if (auto made = make_private_subfolder(path.parent_path()); !made) return fail(made.error());
  if (replace_private_file(path, logins.dump(1) + "\n")) return {};
  return failed_with_errno(path);
}

std::string text_of(const Json& login, const char* member) {
  const auto found = login.is_object() ? login.find(member) : login.end();
  return login.is_object() && found != login.end() && found->is_string() ? found->get<std::string>()
                                                                         : std::string();
}

}  // namespace

Result<std::optional<std::string>> SavedLogins::find(const std::string& url) const {
  const auto logins = read_logins(file_);
  if (!logins) return fail(logins.error());
  const auto found = logins->find(url);
  if (found == logins->end()) return std::optional<std::string>();
  const std::string secret = text_of(*found, "secret");
  // Both are ISO 8601 UTC with six decimals, so that they compare as texts.
  if (secret.empty() || text_of(*found, "expires") <= to_iso8601(SystemClock().now()))
    return std::optional<std::string>();
  return std::optional(secret);
}

Result<void> SavedLogins::save(const std::string& url, const std::string& secret,
                               const std::string& expires) const {
  auto logins = read_logins(file_);
  if (!logins) return fail(logins.error());
  (*logins)[url] = {{"secret", secret}, {"expires", expires}};
  return write_logins(file_, *logins);
}

Result<void> SavedLogins::remove(const std::string& url) const {
  auto logins = read_logins(file_);
  if (!logins) return fail(logins.error());
  if (logins->erase(url) == 0) return {};
  return write_logins(file_, *logins);
}

std::optional<fs::path> login_file(const Environment& environment) {
  if (const auto folder = environment("XDG_CONFIG_HOME"))
    return fs::path(*folder) / "dripline" / "logins.json";
  if (const auto home = environment("HOME"))
    return fs::path(*home) / ".config" / "dripline" / "logins.json";
  return std::nullopt;
}

}  // namespace dripline::client
