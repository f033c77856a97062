#include "storage/impl/chunk_cache.hpp"

namespace dripline::storage {

std::shared_ptr<const CachedChunk> ChunkCache::find(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->chunk;
}

void ChunkCache::insert(const Key& key, std::shared_ptr<const CachedChunk> chunk) {
  const std::lock_guard lock(mutex_);
  if (index_.contains(key)) return;  // another reader was faster
  bytes_ += chunk->bytes.size();
  entries_.push_front({key, std::move(chunk)});
  index_.emplace(key, entries_.begin());
  while (bytes_ > capacity_) {
    bytes_ -= entries_.back().chunk->bytes.size();
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
}

}  // namespace dripline::storage
