#include "server/app/restore.hpp"

#include <fmt/format.h>
#include <cstdio>

#include "storage/backup/backup_folder.hpp"

namespace dripline::app {

Result<std::string> restore_backup(const Settings& settings) {
  if (settings.backups.empty())
    return fail(Errc::NotFound, "--restore needs --backups, the folder of the backups");
  auto folder = backup::BackupFolder::open(settings.backups);
  if (!folder) return fail(folder.error());
  std::string id = settings.restore;
  if (id == kNewestBackup) {
    const auto listed = folder->list();
    if (!listed) return fail(listed.error());
    if (listed->backups.empty())
      return fail(Errc::NotFound, "there is no backup in {}", settings.backups);
    const backup::Backup* const newest = backup::newest(listed->backups, SystemClock().now());
    if (newest == nullptr)
      return fail(Errc::NotFound, "every backup in {} is of a time that has not come: name one",
                  settings.backups);
    id = newest->id;
    if (listed->backups.back().id != id)
      fmt::print("{} is of a time that has not come, and is passed over\n",
                 listed->backups.back().id);
  }
  std::uint64_t shown = 0;
  const auto watch = [&](backup::Phase, std::uint64_t done, std::uint64_t total) {
    constexpr std::uint64_t kPercent = 100, kStep = 10;
    const std::uint64_t percent = total == 0 ? kPercent : done * kPercent / total;
    if (percent < shown + kStep) return true;
    shown = percent;
    fmt::print("restoring {}: {} %\n", id, percent);
    std::fflush(stdout);
    return true;
  };
  auto restored = folder->restore(id, settings.state, watch);
  if (!restored) return fail(restored.error());
  return id;
}

}  // namespace dripline::app
