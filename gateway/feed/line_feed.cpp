#include "gateway/feed/line_feed.hpp"

#include <algorithm>

namespace dripline::feed {

using interpreter::TextWindow;

namespace {

TextWindow failed(std::string reason) {
  TextWindow window;
  window.state = TextWindow::State::Failed;
  window.reason = std::move(reason);
  return window;
}

}  // namespace

void LineFeed::append(std::string_view text) {
  cache_.store(interpreter::kMainProgram, received_, text);
  hash_.update(text);
  received_ += text.size();
}

TextWindow LineFeed::fetch(interpreter::ProgramIndex program, std::uint64_t offset,
                           std::size_t min_bytes) {
  if (program != interpreter::kMainProgram || offset > received_)
    return failed("there is no text at this place on a line");
  consumed_ = std::max(consumed_, offset);
  const std::uint64_t available = received_ - offset;
  const bool is_enough = available >= min_bytes && available > 0;
  if (!is_enough && !has_ended_) {
    if (!reason_.empty()) return failed(reason_);
    consumed_ = received_;  // this is a part of a block: the rest needs room
    return {};
  }
  const std::size_t size = static_cast<std::size_t>(
      std::min<std::uint64_t>(available, std::max<std::size_t>(min_bytes, kPiece)));
  const std::string_view text = gather(offset, size);
  if (text.size() < size)
    return failed(
        fmt::format("byte {} of the program is gone: of what came over the line the last "
                    "{} KiB are kept, up to byte {}",
                    offset, kKeptBytes / 1024, received_));
  TextWindow window;
  window.state = TextWindow::State::Ready;
  window.text = text;
  window.reaches_end = has_ended_ && offset + text.size() == received_;
  return window;
}

std::string_view LineFeed::gather(std::uint64_t offset, std::size_t size) {
  const std::string_view first = cache_.view(interpreter::kMainProgram, offset);
  if (first.size() >= size) return first.substr(0, size);
  stitched_.clear();
  while (stitched_.size() < size) {
    const std::string_view piece =
        cache_.view(interpreter::kMainProgram, offset + stitched_.size());
    if (piece.empty()) break;
    stitched_.append(piece.substr(0, size - stitched_.size()));
  }
  return stitched_;
}

interpreter::ProgramLookup LineFeed::find(std::string_view) {
  return {interpreter::ProgramLookup::State::NotFound, 0};
}

}  // namespace dripline::feed
