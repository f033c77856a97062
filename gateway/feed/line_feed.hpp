#pragma once

#include <string>

#include "gateway/feed/chunk_cache.hpp"
#include "gateway/feed/program_feed.hpp"

namespace dripline::feed {

/// A run's text as it comes over a line: in order, once, until the sender ends. What was executed
/// is kept as far as the cache holds, so that loops work; a jump back further than that fails, as
/// does the text after a line that broke. Pure; one thread.
class LineFeed final : public ProgramFeed {
 public:
  static constexpr std::size_t kKeptBytes = 8 * 1024 * 1024;
  /// Given to the interpreter at a time, so that room in the control's memory is told in time.
  static constexpr std::size_t kPiece = 1024;

  explicit LineFeed(std::size_t kept_bytes = kKeptBytes) : cache_(kept_bytes) {}

  /// More text. Not after `end` or `break_off`.
  void append(std::string_view text);
  /// That was all of it.
  void end() { has_ended_ = true; }
  /// No more will come, and the end is missing: the text that came is still given.
  void break_off(std::string reason) { reason_ = std::move(reason); }

  /// Bytes the interpreter has taken, or waits beyond: all before may be replaced by new ones.
  std::uint64_t consumed() const { return consumed_; }

  interpreter::TextWindow fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                                std::size_t min_bytes) override;
  interpreter::ProgramLookup find(std::string_view name) override;
  std::uint64_t sent() const override { return received_; }
  Digest content_digest() const override { return hash_.digest(); }
  std::uint64_t content_length() const override { return received_; }

 private:
  std::string_view gather(std::uint64_t offset, std::size_t size);

  ChunkCache cache_;
  std::string stitched_;
  Sha256 hash_;
  std::uint64_t received_ = 0, consumed_ = 0;
  bool has_ended_ = false;
  std::string reason_;
};

}  // namespace dripline::feed
