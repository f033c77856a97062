#include "gateway/feed/chunk_cache.hpp"

#include <algorithm>

namespace dripline::feed {

std::string_view ChunkCache::view(interpreter::ProgramIndex program, std::uint64_t offset) {
  const std::string_view text = peek(program, offset);
  if (text.empty()) return text;
  last_viewed_ = {program, offset / kChunkBytes};
  chunks_.find(last_viewed_)->second.used = ++tick_;
  return text;
}

std::string_view ChunkCache::peek(interpreter::ProgramIndex program, std::uint64_t offset) const {
  const auto found = chunks_.find({program, offset / kChunkBytes});
  const std::size_t begin = offset % kChunkBytes;
  if (found == chunks_.end() || begin >= found->second.filled) return {};
  return {found->second.text->data() + begin, found->second.filled - begin};
}

HeldText ChunkCache::around(interpreter::ProgramIndex program, std::uint64_t offset,
                            std::size_t reach) const {
  HeldText held{.offset = offset - std::min<std::uint64_t>(offset, reach), .text = {}};
  const std::uint64_t end = offset + reach;
  for (std::uint64_t at = held.offset; at < end;) {
    const std::string_view text = peek(program, at).substr(0, end - at);
    if (text.empty() && at > offset) break;
    if (text.empty()) {  // a gap before the byte: the text begins after it
      at += kChunkBytes - at % kChunkBytes;
      if (at > offset) return {};
      held = {.offset = at, .text = {}};
      continue;
    }
    held.text += text;
    at += text.size();
  }
  return held;
}

std::size_t ChunkCache::store(interpreter::ProgramIndex program, std::uint64_t offset,
                              std::string_view text) {
  std::size_t stored = 0;
  while (!text.empty()) {
    const std::size_t begin = offset % kChunkBytes;
    const std::size_t length = std::min(text.size(), kChunkBytes - begin);
    stored += store_in_chunk({program, offset / kChunkBytes}, begin, text.substr(0, length));
    offset += length;
    text.remove_prefix(length);
  }
  return stored;
}

std::size_t ChunkCache::filled(Key key) const {
  const auto found = chunks_.find(key);
  return found == chunks_.end() ? 0 : found->second.filled;
}

std::size_t ChunkCache::store_in_chunk(Key key, std::size_t begin, std::string_view text) {
  const std::size_t held = filled(key);
  const std::size_t end = begin + text.size();
  if (begin > held || end <= held) return 0;
  if (held == 0) make_room();
  Chunk& chunk = chunks_[key];
  if (!chunk.text) chunk.text = std::make_unique<std::array<char, kChunkBytes>>();
  std::copy(text.begin(), text.end(), chunk.text->begin() + static_cast<std::ptrdiff_t>(begin));
  chunk.filled = end;
  chunk.used = ++tick_;
  return end - held;
}

void ChunkCache::make_room() {
  while (chunks_.size() >= max_chunks_) {
    auto oldest = chunks_.end();
    for (auto it = chunks_.begin(); it != chunks_.end(); ++it) {
      if (it->first == last_viewed_) continue;
      if (oldest == chunks_.end() || it->second.used < oldest->second.used) oldest = it;
    }
    if (oldest == chunks_.end()) return;
    chunks_.erase(oldest);
  }
}

}  // namespace dripline::feed
