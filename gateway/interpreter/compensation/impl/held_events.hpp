#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "gateway/interpreter/event.hpp"

namespace dripline::interpreter::compensation::impl {

inline constexpr std::size_t kMaxHeldEvents = 64;
inline constexpr std::size_t kMaxHeldText = 4096;

/// An event with a text, whose characters are kept apart.
struct HeldText {
  enum class Kind : std::uint8_t { Output, Open, OpenNamed, Message };
  Kind kind = Kind::Output;
  OutputDevice device = OutputDevice::File;
  Origin origin;
  std::uint32_t begin = 0, size = 0;
};
struct BlockEnd {
  Origin origin;
};
/// Rapid and Line are moves of axes outside the plane.
using HeldEvent = std::variant<BlockEnd, Rapid, Line, Dwell, Spindle, Coolant, ToolChange,
                               Miscellaneous, PinChange, Stop, UnitsChange, Close, HeldText>;

/// What came after the move that waits, in order. Fixed size.
class HeldEvents {
 public:
  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  const HeldEvent& operator[](std::size_t at) const { return events_[at]; }
  std::string_view text(const HeldText& of) const {
    return std::string_view{text_.data(), text_size_}.substr(of.begin, of.size);
  }
  /// False when there is no room.
  template <class Event>
  bool push(const Event& event) {
    if (count_ == kMaxHeldEvents) return false;
    events_[count_++].template emplace<Event>(event);
    return true;
  }
  /// While much waits, ends of blocks that did nothing in between are told by the last of them: a
  /// long calculation between two moves needs no room.
  bool push(const BlockEnd& end) {
    if (count_ >= kMaxHeldEvents / 2) {
      if (auto* last = std::get_if<BlockEnd>(&events_[count_ - 1])) {
        *last = end;
        return true;
      }
    }
    return push<BlockEnd>(end);
  }
  bool push(HeldText text, std::string_view content) {
    if (content.size() > kMaxHeldText - text_size_) return false;
    text.begin = static_cast<std::uint32_t>(text_size_);
    text.size = static_cast<std::uint32_t>(content.size());
    if (!push(text)) return false;
    content.copy(text_.data() + text_size_, content.size());
    text_size_ += content.size();
    return true;
  }
  void clear() { count_ = text_size_ = 0; }

 private:
  std::array<HeldEvent, kMaxHeldEvents> events_;
  std::array<char, kMaxHeldText> text_{};
  std::size_t count_ = 0, text_size_ = 0;
};

}  // namespace dripline::interpreter::compensation::impl
