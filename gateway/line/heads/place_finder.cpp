#include "gateway/line/heads/place_finder.hpp"

#include <fmt/format.h>

#include "gateway/line/block_ledger.hpp"

namespace dripline::line {
namespace {

constexpr std::size_t kBlockHead = 24;

}  // namespace

std::string to_text(const WantedPlace& wanted) {
  if (wanted.byte) return fmt::format("byte {}", *wanted.byte);
  if (wanted.line) return fmt::format("line {}", *wanted.line);
  if (wanted.tool) return fmt::format("change to tool {}", *wanted.tool);
  return fmt::format("block N{}", wanted.sequence.value_or(0));
}

PlaceFinder::PlaceFinder(const WantedPlace& wanted, std::string_view control)
    : wanted_(wanted), kept_(wanted.tool ? kMaxScannedBlock : kBlockHead) {
  if (wanted.tool) tools_.emplace(control, *wanted.tool);
}

bool PlaceFinder::look(std::string_view piece) {
  for (const char c : piece) {
    if (look(c)) return true;
  }
  if (!piece.empty()) ends_in_block_ = piece.back() != '\n';
  return false;
}

bool PlaceFinder::look_at_end() {
  return ends_in_block_ && !wanted_.byte && end_block();
}

bool PlaceFinder::look(char c) {
  if (wanted_.byte && place_.byte + at_ == *wanted_.byte) {
    place_.byte += at_;
    return true;
  }
  if (c != '\n') {
    if (head_.size() < kept_) head_ += c;
    ++at_;
    return false;
  }
  return end_block();
}

/// The block that ends is the wanted one, or the next begins.
bool PlaceFinder::end_block() {
  if (wanted_.line && place_.line == *wanted_.line) return true;
  if (wanted_.sequence && sequence_number(head_) == static_cast<std::int64_t>(*wanted_.sequence)) {
    return true;
  }
  if (tools_ && tools_->is_change(head_)) return true;
  place_.byte += at_ + 1;
  ++place_.line;
  at_ = 0;
  head_.clear();
  return false;
}

}  // namespace dripline::line
