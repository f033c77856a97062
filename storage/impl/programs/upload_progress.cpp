#include "storage/impl/programs/upload_progress.hpp"

#include <algorithm>

#include "storage/programs/chunk_codec.hpp"

namespace dripline::storage {

void UploadProgress::advance(std::span<const std::byte> bytes) {
  if (hash) hash->update(bytes);
  const std::uint64_t received_before = received;
  received += bytes.size();
  const std::uint64_t chunk_begin = received - received % kChunkBytes;
  if (chunk_begin > received_before) {  // the old tail is complete
    tail.clear();
    bytes = bytes.subspan(chunk_begin - received_before);
  } else if (chunk_begin == received_before) {
    tail.clear();
  }
  tail.insert(tail.end(), bytes.begin(), bytes.end());
}

std::shared_ptr<UploadProgress> UploadProgressTable::find(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(entries_, id, [](const auto& entry) { return entry.first; });
  if (found == entries_.end()) return nullptr;
  std::rotate(found, found + 1, entries_.end());
  return entries_.back().second;
}

std::shared_ptr<UploadProgress> UploadProgressTable::insert(
    const std::string& id, std::shared_ptr<UploadProgress> progress) {
  if (auto kept = find(id)) return kept;
  const std::lock_guard lock(mutex_);
  if (entries_.size() >= kCapacity) entries_.erase(entries_.begin());
  entries_.emplace_back(id, progress);
  return progress;
}

void UploadProgressTable::erase(const std::string& id) {
  const std::lock_guard lock(mutex_);
  std::erase_if(entries_, [&](const auto& entry) { return entry.first == id; });
}

void UploadProgressTable::clear() {
  const std::lock_guard lock(mutex_);
  entries_.clear();
}

}  // namespace dripline::storage
