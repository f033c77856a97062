#include "server/library/history/archive_check.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include "protocol/archive/archive_entry.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return time.tv_sec * kSecond + time.tv_nsec;
}

}  // namespace

std::optional<ArchiveCheck::Mark> ArchiveCheck::mark_of(const std::string& file) const {
  struct stat found {};
  if (::stat((parts_.folder / file).c_str(), &found) != 0) return std::nullopt;
  return Mark{static_cast<std::uint64_t>(found.st_size), static_cast<std::int64_t>(found.st_ino),
              nanoseconds(found.st_ctim), nanoseconds(found.st_mtim)};
}

void ArchiveCheck::read(const std::string& file, Known& known) const {
  known.mark = mark_of(file);
  known.fault.clear();
  if (!known.mark) {
    known.fault = "it is missing";
    return;
  }
  const auto digest = archive::digest_of(parts_.folder / file);
  if (!digest) {
    known.fault = digest.error().what;
  } else if (*digest != known.sha256) {
    known.fault = fmt::format("it was changed: its SHA-256 is {}, audit entry {} has {}",
                              digest->hex(), known.entry, known.sha256.hex());
  }
}

Result<std::map<std::string, ArchiveCheck::Known>> ArchiveCheck::trail(
    const std::stop_token& stop) const {
  constexpr std::uint64_t kPiece = 10'000;
  std::map<std::string, Known> known;
  for (std::uint64_t after = 0; !stop.stop_requested();) {
    const auto entries = parts_.store.audit.chained(after, kPiece);
    if (!entries) return fail(entries.error());
    for (const auto& [entry, digest, fault] : *entries) {
      after = entry.number;
      if (entry.action != archive::kMadeAction) continue;
      if (const auto sha256 = archive::digest_in(entry.detail))
        known.insert_or_assign(entry.subject, Known{.sha256 = *sha256, .entry = entry.number});
    }
    if (entries->size() < kPiece) break;
  }
  return known;
}

/// The list can be changed as well as a file can.
Result<std::vector<ArchiveCheck::Fault>> ArchiveCheck::compare_list(
    const std::map<std::string, Known>& known) const {
  constexpr std::uint64_t kPage = 1000;
  std::vector<Fault> faults;
  std::map<std::string, Digest> listed;
  for (std::uint64_t offset = 0;; offset += kPage) {
    const auto page = parts_.store.archives.list({.limit = kPage, .offset = offset});
    if (!page) return fail(page.error());
    for (const auto& archive : *page) listed.emplace(archive.file, archive.sha256);
    if (page->size() < kPage) break;
  }
  for (const auto& [file, sha256] : listed) {
    const auto found = known.find(file);
    if (found == known.end()) {
      faults.push_back({file, "it is listed, but no audit entry has its making"});
    } else if (found->second.sha256 != sha256) {
      faults.push_back(
          {file, fmt::format("it is listed with the SHA-256 {}, audit entry {} has {}",
                             sha256.hex(), found->second.entry, found->second.sha256.hex())});
    }
  }
  for (const auto& [file, one] : known) {
    if (!listed.contains(file))
      faults.push_back({file, fmt::format("it is not listed, audit entry {} has it", one.entry)});
  }
  return faults;
}

void ArchiveCheck::publish(UtcTime at, std::vector<Fault> of_list) {
  of_list_ = std::move(of_list);
  State now{.at = at, .archives = known_.size(), .faults = of_list_};
  for (const auto& [file, one] : known_) {
    if (!one.fault.empty()) now.faults.push_back({file, one.fault});
  }
  const std::lock_guard lock(mutex_);
  const bool was_faulty = state_ && !state_->faults.empty();
  if (!was_faulty) {
    for (const Fault& fault : now.faults)
      process::log_error("archive {}: {}", fault.file, fault.what);
  }
  state_ = std::move(now);
}

Result<ArchiveCheck::State> ArchiveCheck::check(const std::stop_token& stop) {
  const std::unique_lock busy(check_mutex_, std::try_to_lock);
  if (!busy) return fail(Errc::Busy, "the archives are being checked");
  auto known = trail(stop);
  if (!known) return fail(known.error());
  for (auto& [file, one] : *known) {
    if (stop.stop_requested()) return fail(Errc::Busy, "the server ends");
    read(file, one);
  }
  auto of_list = compare_list(*known);
  if (!of_list) return fail(of_list.error());
  known_ = *std::move(known);
  publish(parts_.clock.now(), *std::move(of_list));
  return *state();
}

Result<void> ArchiveCheck::look() {
  const std::unique_lock busy(check_mutex_, std::try_to_lock);
  if (!busy) return {};
  const auto last = state();
  if (!last) return {};
  constexpr std::uint64_t kNew = 1000;
  const auto newest = parts_.store.archives.list({.limit = kNew, .offset = 0});
  if (!newest) return fail(newest.error());
  // Made since: their entries are in the transaction that lists them.
  for (const auto& archive : *newest) {
    if (known_.contains(archive.file)) break;
    known_.emplace(archive.file, Known{.sha256 = archive.sha256, .entry = 0});
  }
  bool is_changed = known_.size() != last->archives;
  for (auto& [file, one] : known_) {
    const auto mark = mark_of(file);
    if (mark == one.mark && (mark || !one.fault.empty())) continue;
    read(file, one);
    is_changed = true;
  }
  if (is_changed) publish(last->at, of_list_);
  return {};
}

std::optional<ArchiveCheck::State> ArchiveCheck::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

Health::Finding ArchiveCheck::finding() const {
  const auto now = state();
  const bool is_faulty = now && !now->faults.empty();
  Health::Finding finding{.level = is_faulty ? Health::Level::Degraded : Health::Level::Ok,
                          .subject = "archives",
                          .what = "an archive is missing or was changed",
                          .detail = {}};
  if (!is_faulty) return finding;
  const Fault& first = now->faults.front();
  finding.detail = fmt::format("{}: {}", first.file, first.what);
  if (now->faults.size() > 1)
    finding.detail += fmt::format(" (and {} more)", now->faults.size() - 1);
  return finding;
}

}  // namespace dripline::library
