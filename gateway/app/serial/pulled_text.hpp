#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "gateway/feed/pull_feed.hpp"
#include "gateway/line/text_source.hpp"

namespace dripline::gateway {

/// A run's text for a line: pulled from the server far ahead of what has left, so that the line
/// does not feel when the server is away. One thread, the gateway's.
class PulledText final : public line::TextSource {
 public:
  struct Buffer {
    std::size_t bytes = 0;  ///< text that is at least kept ahead of the line, once it has come
  };
  static constexpr std::size_t kMinBuffer = 64 * 1024, kMaxBuffer = 64 * 1024 * 1024;
  /// For `ahead` of a line with so many characters a second, within these bounds.
  static Buffer buffer_for(double characters_per_second, std::chrono::seconds ahead);

  PulledText(feed::FeedRun run, const Buffer& buffer, feed::PullFeed::Ask ask);

  Result<std::string> read(std::uint64_t offset, std::uint64_t length) override;

  feed::PullFeed& feed() { return feed_; }
  const feed::PullFeed& feed() const { return feed_; }
  /// Bytes that have come and were not read yet, without a gap.
  std::uint64_t bytes_ahead() const;
  /// The rest of the program is among them.
  bool is_complete() const { return read_to_ + bytes_ahead() >= size_; }

 private:
  const std::uint64_t size_;
  feed::PullFeed feed_;
  std::uint64_t read_at_ = 0, read_to_ = 0;
};

}  // namespace dripline::gateway
