#include "server/library/waiting_entries.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

#include "protocol/base/durable_file.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".json", kUnfinished = ".new";

tl::unexpected<Error> errno_failure(const fs::path& path) {
  return fail(Errc::Io, "{}: {}", path.string(), std::generic_category().message(errno));
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

/// What cannot be read is empty.
std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::optional<storage::AuditEntry> decode(const std::string& text) {
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
  if (!replace_private_file(path, encode(entry))) return errno_failure(path);
  return name;
}

void WaitingEntries::drop(const std::string& name) const {
  ::unlink((folder_ / name).c_str());
}

WaitingEntries::Read WaitingEntries::read() const {
  Read read;
  const auto log_failure = [&](const std::string& name, const char* why) {
    ++read.failures;
    process::log_error("audit entry not read: {}: {}", (folder_ / name).string(), why);
  };
  std::vector<std::string> names;
  std::error_code ec;
  for (fs::directory_iterator at(folder_, ec); !ec && at != fs::directory_iterator();
       at.increment(ec)) {
    const fs::directory_entry& file = *at;
    std::string name = file.path().filename().string();
    if (name.ends_with(kUnfinished)) drop(name);  // it was cut off before its call returned
    if (!name.ends_with(kEnding)) continue;
    if (std::error_code unknown; file.is_regular_file(unknown)) {
      names.push_back(std::move(name));
    } else {
      log_failure(name, "it is no file");
    }
  }
  std::ranges::sort(names);
  for (std::string& name : names) {
    auto entry = decode(text_of(folder_ / name));
    if (entry) {
      read.kept.push_back({std::move(name), *std::move(entry)});
    } else {
      log_failure(name, "it is no entry");
    }
  }
  return read;
}

}  // namespace dripline::library
