#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

namespace dripline::machine::impl {

/// Texts waiting in the queue: first in, first out, in one block of memory. A text is never split.
class TextRing {
 public:
  struct Piece {
    std::size_t offset = 0, size = 0;
    std::size_t taken = 0;  ///< with what was skipped at the ring's end
  };

  explicit TextRing(std::size_t capacity)
      : bytes_(std::make_unique<char[]>(capacity)), capacity_(capacity) {}

  std::size_t free() const { return capacity_ - used_; }
  void clear() { used_ = write_ = 0; }

  /// Absent when it does not fit.
  std::optional<Piece> push(std::string_view text) {
    if (used_ == 0) write_ = 0;
    const std::size_t at_end = capacity_ - write_;
    const std::size_t skipped = text.size() > at_end ? at_end : 0;
    if (skipped + text.size() > free()) return std::nullopt;
    const Piece piece{skipped > 0 ? 0 : write_, text.size(), skipped + text.size()};
    if (!text.empty()) std::memcpy(bytes_.get() + piece.offset, text.data(), text.size());
    write_ = (piece.offset + text.size()) % capacity_;
    used_ += piece.taken;
    return piece;
  }
  /// Valid until it is popped.
  std::string_view text(const Piece& piece) const {
    return {bytes_.get() + piece.offset, piece.size};
  }
  /// Only the oldest.
  void pop(const Piece& piece) { used_ -= piece.taken; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t capacity_;
  std::size_t write_ = 0, used_ = 0;
};

}  // namespace dripline::machine::impl
