#include "server/folders/folders.hpp"

#include <algorithm>

namespace dripline::folders {

Folders::Folders(const HotFolder::Parts& parts, std::vector<FolderSettings> settings)
    : store_(parts.sources.store.folders) {
  for (auto& folder : settings)
    folders_.push_back(std::make_unique<HotFolder>(parts, std::move(folder)));
}

Folders::~Folders() = default;

void Folders::begin() {
  for (const auto& folder : folders_) watches_.push_back(std::make_unique<FolderWatch>(*folder));
}

void Folders::request_end() {
  for (const auto& watch : watches_) watch->request_end();
}

Result<void> Folders::end(std::chrono::steady_clock::time_point until) {
  std::string silent;
  for (const auto& watch : watches_) {
    if (watch->has_ended(until)) continue;
    silent += (silent.empty() ? "" : ", ") + watch->folder().settings().name;
  }
  if (!silent.empty()) return fail(Errc::Timeout, "hot folder {} does not answer", silent);
  watches_.clear();
  return {};
}

void Folders::look() {
  for (const auto& folder : folders_) folder->report_silence();
}

std::vector<FolderState> Folders::states() const {
  std::vector<FolderState> states;
  states.reserve(folders_.size());
  for (const auto& folder : folders_) states.push_back(folder->state());
  return states;
}

Result<std::vector<storage::FolderFile>> Folders::files(const std::optional<std::string>& folder,
                                                        storage::Page page) {
  const bool is_known = !folder || std::ranges::any_of(folders_, [&](const auto& candidate) {
    return candidate->settings().name == *folder;
  });
  if (!is_known) return fail(Errc::NotFound, "folder '{}' is not configured", *folder);
  return store_.list(folder, page);
}

}  // namespace dripline::folders
