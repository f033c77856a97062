#include "storage/cache/recent_files.hpp"

#include <cstring>

namespace dripline::cache {

/// A digest is as good as random.
std::size_t RecentFiles::Hash::operator()(const FileKey& key) const {
  std::size_t hash = 0;
  std::memcpy(&hash, key.digest.bytes.data(), sizeof hash);
  return hash ^ static_cast<std::size_t>(key.kind);
}

void RecentFiles::add(const FileKey& key, std::uint64_t bytes) {
  entries_.push_front({key, bytes});
  places_.emplace(key, entries_.begin());
  bytes_ += bytes;
}

std::uint64_t RecentFiles::use(const FileKey& key) {
  const auto place = places_.find(key);
  if (place == places_.end()) return 0;
  entries_.splice(entries_.begin(), entries_, place->second);
  return place->second->bytes;
}

void RecentFiles::drop(const FileKey& key) {
  const auto place = places_.find(key);
  if (place == places_.end()) return;
  bytes_ -= place->second->bytes;
  entries_.erase(place->second);
  places_.erase(place);
}

std::optional<FileKey> RecentFiles::oldest() const {
  if (entries_.empty()) return std::nullopt;
  return entries_.back().key;
}

}  // namespace dripline::cache
