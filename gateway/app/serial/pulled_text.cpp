#include "gateway/app/serial/pulled_text.hpp"

#include <algorithm>

namespace dripline::gateway {
namespace {

constexpr std::size_t kCacheMargin = 1024 * 1024;  ///< around the window

/// Text is asked for in requests of some size: the window is larger by one, so that what is here
/// does not fall below the buffer while the server is there.
feed::PullFeedOptions options_of(const PulledText::Buffer& buffer) {
  feed::PullFeedOptions options;
  options.max_window = buffer.bytes + options.request_bytes;
  options.min_window = options.max_window;
  options.cache_bytes = options.max_window + kCacheMargin;
  return options;
}

}  // namespace

PulledText::Buffer PulledText::buffer_for(double characters_per_second,
                                          std::chrono::seconds ahead) {
  const double wanted = characters_per_second * std::chrono::duration<double>(ahead).count();
  const double bytes = std::clamp<double>(wanted, kMinBuffer, kMaxBuffer);
  return {.bytes = static_cast<std::size_t>(bytes)};
}

PulledText::PulledText(feed::FeedRun run, const Buffer& buffer, feed::PullFeed::Ask ask)
    : size_(run.size), feed_(std::move(run), options_of(buffer), std::move(ask)) {}

Result<std::string> PulledText::read(std::uint64_t offset, std::uint64_t length) {
  const auto window = feed_.fetch(interpreter::kMainProgram, offset, 1);
  if (window.state == interpreter::TextWindow::State::Failed)
    return fail(Errc::Io, "{}", window.reason);
  read_at_ = read_to_ = offset;
  if (window.state != interpreter::TextWindow::State::Ready) return std::string();
  std::string piece(window.text.substr(0, length));
  read_to_ = offset + piece.size();
  return piece;
}

std::uint64_t PulledText::bytes_ahead() const {
  const std::uint64_t ahead = feed_.bytes_ahead();
  return ahead - std::min(ahead, read_to_ - read_at_);
}

}  // namespace dripline::gateway
