#include "storage/cache/disk_cache.hpp"

#include "storage/cache/list_file.hpp"
#include "storage/programs/chunk_codec.hpp"

namespace dripline::cache {
namespace {

using Kind = FileKey::Kind;
using SteadyClock = std::chrono::steady_clock;

std::uint64_t on_disk(std::uint64_t bytes) {
  return (bytes + DiskCache::kBlock - 1) / DiskCache::kBlock * DiskCache::kBlock;
}

}  // namespace

DiskCache::DiskCache(DiskCacheOptions options)
    : options_(std::move(options)), folder_(options_.folder) {}

Result<std::unique_ptr<DiskCache>> DiskCache::open(DiskCacheOptions options) {
  std::unique_ptr<DiskCache> cache(new DiskCache(std::move(options)));
  const auto found = cache->folder_.begin();
  if (!found) return fail(found.error());
  cache->load(*found);
  return cache;
}

void DiskCache::load(const std::vector<CacheFolder::Found>& found) {
  const std::lock_guard lock(mutex_);
  for (const auto& file : found) files_.add(file.key, on_disk(file.size));
  make_room(0);
}

/// Hold the mutex.
void DiskCache::make_room(std::uint64_t bytes) {
  while (files_.bytes() + bytes > options_.capacity) {
    const auto oldest = files_.oldest();
    if (!oldest) return;
    folder_.remove(*oldest);
    files_.drop(*oldest);
  }
}

/// Hold the mutex.
std::uint64_t DiskCache::use(const FileKey& key) {
  const std::uint64_t bytes = files_.use(key);
  if (bytes > 0) folder_.touch(key);
  return bytes;
}

void DiskCache::drop_damaged(const FileKey& key) {
  const std::lock_guard lock(mutex_);
  if (!files_.has(key)) return;  // it made room meanwhile
  ++damaged_;
  folder_.remove(key);
  files_.drop(key);
}

std::shared_ptr<const storage::ContentList> DiskCache::find_list(const Digest& content) {
  const FileKey key{Kind::List, content};
  {
    const std::lock_guard lock(mutex_);
    if (!files_.has(key)) return nullptr;
    use(key);
  }
  const auto bytes = folder_.read(key);
  auto list = bytes ? read_list(content, *bytes) : std::nullopt;
  if (list) return std::make_shared<const storage::ContentList>(*std::move(list));
  drop_damaged(key);
  return nullptr;
}

void DiskCache::keep_list(const Digest& content, const storage::ContentList& list) {
  const FileKey key{Kind::List, content};
  if (!is_kept_or_paused(key)) keep(key, to_bytes(content, list));
}

std::optional<std::vector<std::byte>> DiskCache::find_chunk(const Place& place,
                                                            std::uint64_t size) {
  const FileKey key{Kind::Chunk, place.chunk};
  {
    const std::lock_guard lock(mutex_);
    if (!files_.has(key)) return std::nullopt;
    // The list is of no use without its chunks, nor they without it.
    use({Kind::List, place.content});
    use(key);
  }
  const auto frame = folder_.read(key);
  if (frame) {
    auto plain = storage::decode_chunk(place.chunk, size, *frame);
    if (plain) {
      ++hits_;
      return *std::move(plain);
    }
  }
  drop_damaged(key);
  return std::nullopt;
}

void DiskCache::keep_chunk(const Digest& chunk, std::span<const std::byte> frame, Reason reason) {
  ++(reason == Reason::Asked ? misses_ : ahead_);
  const FileKey key{Kind::Chunk, chunk};
  if (!is_kept_or_paused(key)) keep(key, frame);
}

std::uint64_t DiskCache::use_chunk(const Digest& chunk) {
  const std::lock_guard lock(mutex_);
  return use({Kind::Chunk, chunk});
}

bool DiskCache::is_kept_or_paused(const FileKey& key) {
  const std::lock_guard lock(mutex_);
  return files_.has(key) || SteadyClock::now() < paused_until_;
}

void DiskCache::keep(const FileKey& key, std::span<const std::byte> bytes) {
  if (on_disk(bytes.size()) > options_.capacity) return;
  note(store(key, bytes));
}

Result<void> DiskCache::store(const FileKey& key, std::span<const std::byte> bytes) {
  const auto left = folder_.free_bytes();
  if (left && *left < options_.reserve + bytes.size()) {
    constexpr unsigned kMega = 20;
    return fail(Errc::Io, "{}: its disk has only {} MiB left, and {} MiB are to stay free",
                folder_.path().string(), *left >> kMega, options_.reserve >> kMega);
  }
  const auto unfinished = folder_.write(bytes, ++unfinished_);
  if (!unfinished) return fail(unfinished.error());
  const std::lock_guard lock(mutex_);
  if (files_.has(key)) {  // another one was faster
    CacheFolder::discard(*unfinished);
    return {};
  }
  make_room(on_disk(bytes.size()));
  auto published = folder_.publish(*unfinished, key);
  if (published) {
    files_.add(key, on_disk(bytes.size()));
  } else {
    CacheFolder::discard(*unfinished);
  }
  return published;
}

void DiskCache::note(const Result<void>& stored) {
  std::string news;
  {
    const std::lock_guard lock(mutex_);
    const bool was_well = fault_.empty();
    fault_ = stored ? "" : stored.error().what;
    paused_until_ = stored ? SteadyClock::time_point{} : SteadyClock::now() + options_.pause;
    if (was_well) news = fault_;
  }
  if (!news.empty() && options_.on_fault) options_.on_fault(news);
}

DiskCache::State DiskCache::state() const {
  const std::lock_guard lock(mutex_);
  return {.capacity = options_.capacity,
          .bytes = files_.bytes(),
          .files = files_.count(),
          .hits = hits_,
          .misses = misses_,
          .ahead = ahead_,
          .damaged = damaged_,
          .fault = fault_};
}

}  // namespace dripline::cache
