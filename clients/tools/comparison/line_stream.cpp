#include "clients/tools/comparison/line_stream.hpp"

#include <algorithm>
#include <cstring>

namespace dripline::comparison {

bool LineStream::fetch(std::uint64_t offset) {
  window_ = {};
  if (offset >= limit_) return reaches_end_ = true;
  const auto fetched = source_.fetch(program_, offset, interpreter::ProgramSource::kMaxWindow);
  if (fetched.state != interpreter::TextWindow::State::Ready) {
    error_ = fetched.reason.empty() ? "the text is not all there" : fetched.reason;
    return false;
  }
  window_ = fetched.text.substr(
      0, static_cast<std::size_t>(std::min<std::uint64_t>(limit_ - offset, fetched.text.size())));
  reaches_end_ = fetched.reaches_end || offset + window_.size() >= limit_;
  return true;
}

void LineStream::move_to(std::uint64_t offset, std::uint64_t number) {
  offset_ = offset;
  number_ = number;
  window_ = {};
  reaches_end_ = false;
}

bool LineStream::next(TextLine& line) {
  std::size_t end = window_.substr(0, kMaxLine).find('\n');
  if (end == std::string_view::npos && window_.size() < kMaxLine && !reaches_end_) {
    if (!fetch(offset_)) return false;
    end = window_.substr(0, kMaxLine).find('\n');
  }
  if (window_.empty()) return false;
  line.number = number_;
  line.offset = offset_;
  line.has_end = end != std::string_view::npos;
  line.text = window_.substr(0, line.has_end ? end : std::min(window_.size(), kMaxLine));
  const std::size_t size = line.text.size() + (line.has_end ? 1 : 0);
  window_.remove_prefix(size);
  offset_ += size;
  number_ += line.has_end ? 1 : 0;
  return true;
}

void LineStream::skip_equal(LineStream& a, LineStream& b) {
  std::uint64_t passed = 0, lines = 0, in_line = 0;  // in_line: bytes passed of a line
  while (a.fetch(a.offset_ + passed) && b.fetch(b.offset_ + passed)) {
    const std::size_t size = std::min({a.window_.size(), b.window_.size(), std::size_t{1} << 20});
    if (size == 0) break;
    const auto ends = a.window_.begin() + static_cast<std::ptrdiff_t>(size);
    const bool is_same = std::memcmp(a.window_.data(), b.window_.data(), size) == 0;
    const auto stop =
        is_same ? ends : std::mismatch(a.window_.begin(), ends, b.window_.begin()).first;
    const std::string_view same =
        a.window_.substr(0, static_cast<std::size_t>(stop - a.window_.begin()));
    lines += static_cast<std::uint64_t>(std::count(same.begin(), same.end(), '\n'));
    const std::size_t last = same.rfind('\n');
    in_line = last == std::string_view::npos ? in_line + same.size() : same.size() - last - 1;
    passed += same.size();
    if (!is_same) break;
    // Both may end here, without an end of line: the last line is then the same too.
    if (a.reaches_end_ && b.reaches_end_ && a.window_.size() == size && b.window_.size() == size)
      in_line = 0;
  }
  passed -= in_line;
  a.move_to(a.offset_ + passed, a.number_ + lines);
  b.move_to(b.offset_ + passed, b.number_ + lines);
}

}  // namespace dripline::comparison
