#include "gateway/line/block_ledger.hpp"

#include <algorithm>
#include <charconv>

namespace dripline::line {
namespace {

constexpr std::size_t kHead = 24;  ///< enough for blanks, a slash and an N number

}  // namespace

std::int64_t sequence_number(std::string_view block) {
  const auto first = block.find_first_not_of(" \t/");
  if (first == std::string_view::npos) return -1;
  block.remove_prefix(first);
  if (block.front() == 'N' || block.front() == 'n') block.remove_prefix(1);
  std::int64_t number = -1;
  const auto read = std::from_chars(block.data(), block.data() + block.size(), number);
  return read.ec == std::errc{} && number >= 0 ? number : -1;
}

std::string BlockLedger::add_head(std::string_view head) {
  offered_ += head.size();
  block_begin_ = passed_offered_ = offered_;
  return std::string(head);
}

std::string BlockLedger::add(std::string_view piece, bool is_last) {
  std::string offered;
  offered.reserve(piece.size() + 1);
  for (const char c : piece) {
    ++source_;
    if (c == '\r') continue;
    offered += c;
    ++offered_;
    if (c == '\n') {
      end_block();
    } else if (head_.size() < kHead) {
      head_ += c;
    }
  }
  if (is_last && offered_ > block_begin_) {
    offered += '\n';
    ++offered_;
    end_block();
  }
  // Carriage returns after the last block belong to it.
  if (is_last && !marks_.empty()) marks_.back().source = source_;
  return offered;
}

void BlockLedger::end_block() {
  marks_.push_back({.offered = offered_,
                    .source = source_,
                    .line = next_line_++,
                    .sequence = sequence_number(head_)});
  head_.clear();
  block_begin_ = offered_;
}

void BlockLedger::advance(std::uint64_t offered) {
  offered = std::min(offered, offered_);
  left_ = std::max(left_, offered);
  while (!marks_.empty() && marks_.front().offered <= offered) {
    const Mark& mark = marks_.front();
    passed_offered_ = mark.offered;
    passed_source_ = mark.source;
    ++place_.blocks;
    place_.line = mark.line;
    place_.sequence = mark.sequence;
    marks_.pop_front();
  }
  // Inside a block source and offered characters are the same ones.
  const std::uint64_t inside = offered > passed_offered_ ? offered - passed_offered_ : 0;
  place_.bytes = std::max(place_.bytes, passed_source_ + inside);
}

}  // namespace dripline::line
