#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::feed {

/// A piece of a program's text.
struct HeldText {
  std::uint64_t offset = 0;  ///< of its first byte in the program
  std::string text;
  bool reaches_end = false;  ///< the program ends where `text` ends, as far as that is known
  std::uint64_t end() const { return offset + text.size(); }
};

/// Program text in pieces of kChunkBytes, each filled from its beginning; the least recently used
/// pieces go when the bound is reached. Pure; one thread.
class ChunkCache {
 public:
  static constexpr std::size_t kChunkBytes = 32 * 1024;

  struct Key {
    interpreter::ProgramIndex program = 0;
    std::uint64_t index = 0;  ///< offset / kChunkBytes
    friend auto operator<=>(const Key&, const Key&) = default;
  };

  explicit ChunkCache(std::size_t max_bytes) : max_chunks_(max_bytes / kChunkBytes) {}

  /// The contiguous bytes held from `offset` to the end of its chunk; empty when there are none.
  /// Valid until the chunk is dropped; the chunk looked at last is never dropped.
  std::string_view view(interpreter::ProgramIndex program, std::uint64_t offset);
  /// The same without being a use.
  std::string_view peek(interpreter::ProgramIndex program, std::uint64_t offset) const;
  /// What is held without a gap around byte `offset`, at most `reach` bytes before and after it;
  /// empty when that byte is not held. No use either. `reaches_end` is left to the caller.
  HeldText around(interpreter::ProgramIndex program, std::uint64_t offset, std::size_t reach) const;
  /// Takes what fits: bytes that begin beyond the filled part of a chunk, or lie within it, are
  /// left out. Returns the number of new ones.
  std::size_t store(interpreter::ProgramIndex program, std::uint64_t offset, std::string_view text);
  /// Bytes of this chunk that are held, from its beginning.
  std::size_t filled(Key key) const;
  std::size_t bytes() const { return chunks_.size() * kChunkBytes; }

 private:
  struct Chunk {
    std::unique_ptr<std::array<char, kChunkBytes>> text;
    std::size_t filled = 0;
    std::uint64_t used = 0;
  };
  std::size_t store_in_chunk(Key key, std::size_t begin, std::string_view text);
  void make_room();

  std::size_t max_chunks_;
  std::map<Key, Chunk> chunks_;
  Key last_viewed_{~0U, 0};
  std::uint64_t tick_ = 0;
};

}  // namespace dripline::feed
