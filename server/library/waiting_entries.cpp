#include "server/library/waiting_entries.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".json", kUnfinished = ".new";

tl::unexpected<Error> errno_failure(const fs::path& path) {
  return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
}

Result<void> sync_folder(const fs::path& folder) {
  const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return errno_failure(folder);
  const bool is_synced = ::fsync(handle) == 0;
  const auto failure = errno_failure(folder);
  ::close(handle);
  if (is_synced) return {};
  return failure;
}

/// Its owner's alone, like all of the state folder.
Result<void> write_synced(const fs::path& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) return errno_failure(path);
  const bool is_written =
      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  const auto failure = errno_failure(path);
  ::close(file);
  if (is_written) return {};
  ::unlink(path.c_str());
  return failure;
}

std::string encode(const storage::AuditEntry& entry) {
  const nlohmann::json text{{"time", to_iso8601(entry.time)},
                            {"who", entry.who.name},
                            {"credential", entry.who.credential},
                            {"address", entry.who.address},
                            {"action", entry.action},
                            {"subject", entry.subject},
                            {"detail", entry.detail}};
  return text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::optional<storage::AuditEntry> decode(std::istream& text) {
  const auto members = nlohmann::json::parse(text, nullptr, false);
  if (!members.is_object()) return std::nullopt;
  const auto member = [&](const char* name) {
    const auto found = members.find(name);
    return found != members.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const auto time = parse_iso8601(member("time"));
  storage::AuditEntry entry{.time = {},
                            .who = {member("who"), member("credential"), member("address")},
                            .action = member("action"),
                            .subject = member("subject"),
                            .detail = member("detail")};
  if (!time || entry.who.name.empty() || entry.action.empty()) return std::nullopt;
  entry.time = *time;
  return entry;
}

}  // namespace

Result<std::string> WaitingEntries::keep(const storage::AuditEntry& entry) {
  if (::mkdir(folder_.c_str(), S_IRWXU) != 0 && errno != EEXIST) return errno_failure(folder_);
  const auto time = static_cast<std::uint64_t>(entry.time.time_since_epoch().count());
  std::string name = fmt::format("{:020}-{:06}-{}{}", time, ++last_, random_hex(4), kEnding);
  const fs::path path = folder_ / name;
  const fs::path unfinished = path.string() + std::string(kUnfinished);
  if (auto written = write_synced(unfinished, encode(entry)); !written)
    return fail(written.error());
  if (::rename(unfinished.c_str(), path.c_str()) != 0) return errno_failure(path);
  if (auto synced = sync_folder(folder_); !synced) return fail(synced.error());
  return name;
}

void WaitingEntries::drop(const std::string& name) const {
  ::unlink((folder_ / name).c_str());
}

std::vector<WaitingEntries::Kept> WaitingEntries::read() const {
  std::vector<std::string> names;
  std::error_code ec;
  for (const auto& file : fs::directory_iterator(folder_, ec)) {
    std::string name = file.path().filename().string();
    if (name.ends_with(kUnfinished)) drop(name);  // it was cut off before its call returned
    if (name.ends_with(kEnding)) names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  std::vector<Kept> kept;
  for (std::string& name : names) {
    std::ifstream text(folder_ / name);
    auto entry = decode(text);
    if (entry) {
      kept.push_back({std::move(name), *std::move(entry)});
    } else {
      process::log_error("audit entry not read: {}: it is no entry", (folder_ / name).string());
    }
  }
  return kept;
}

}  // namespace dripline::library
