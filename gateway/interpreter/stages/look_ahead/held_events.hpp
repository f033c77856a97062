#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <variant>

#include "gateway/interpreter/core/event.hpp"

/// The events that wait with the move in a stage that looks one move ahead.
namespace dripline::interpreter::look_ahead {

inline constexpr std::size_t kMaxHeldEvents = 256;  ///< without the ends of blocks
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
/// Whether an event only marks the end of a block. A stage with a kind of its own names it here.
template <class Event>
inline constexpr bool kIsBlockEnd = false;
template <>
inline constexpr bool kIsBlockEnd<BlockEnd> = true;

/// The events after the waiting move, in order; Rapid and Line are moves of axes outside the plane,
/// `Own` the events of one stage alone. Fixed size.
template <class... Own>
class HeldEvents {
 public:
  using Event =
      std::variant<BlockEnd, Rapid, Line, Dwell, Spindle, Coolant, ToolChange, Miscellaneous,
                   PinChange, Stop, UnitsChange, Close, HeldText, OverrideInhibit, Own...>;

  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  const Event& operator[](std::size_t at) const { return events_[at]; }
  std::string_view text(const HeldText& of) const {
    return std::string_view{text_.data(), text_size_}.substr(of.begin, of.size);
  }
  /// False when there is no room.
  template <class One>
  bool push(const One& event) {
    if constexpr (kIsBlockEnd<One>) return push_end(event);
    if (counted_ == kMaxHeldEvents || !put(event)) return false;
    ++counted_;
    return true;
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
  void clear() { count_ = counted_ = text_size_ = 0; }

 private:
  /// From so many events on, ends of blocks in a row share a place.
  static constexpr std::size_t kApart = 32;
  /// One end after every other event, and those before kApart.
  static constexpr std::size_t kPlaces = kApart + 2 * kMaxHeldEvents;

  /// When many events wait, the last one of the ends in a row represents all: a long calculation
  /// between two moves needs no room, however many blocks it takes.
  template <class End>
  bool push_end(const End& end) {
    if (count_ >= kApart) {
      if (auto* last = std::get_if<End>(&events_[count_ - 1])) {
        *last = end;
        return true;
      }
    }
    return put(end);
  }
  template <class One>
  bool put(const One& event) {
    if (count_ == kPlaces) return false;
    events_[count_++].template emplace<One>(event);
    return true;
  }

  std::array<Event, kPlaces> events_;
  std::array<char, kMaxHeldText> text_{};
  std::size_t count_ = 0, counted_ = 0, text_size_ = 0;
};

/// Delivers a held event to a sink.
struct Forwarder {
  EventSink& sink;

  void operator()(const BlockEnd& event) const { sink.on_block_end(event.origin); }
  void operator()(const Rapid& event) const { sink.on_rapid(event); }
  void operator()(const Line& event) const { sink.on_line(event); }
  void operator()(const Dwell& event) const { sink.on_dwell(event); }
  void operator()(const Spindle& event) const { sink.on_spindle(event); }
  void operator()(const Coolant& event) const { sink.on_coolant(event); }
  void operator()(const ToolChange& event) const { sink.on_tool(event); }
  void operator()(const Miscellaneous& event) const { sink.on_miscellaneous(event); }
  void operator()(const PinChange& event) const { sink.on_pin(event); }
  void operator()(const Stop& event) const { sink.on_stop(event); }
  void operator()(const UnitsChange& event) const { sink.on_units(event); }
  void operator()(const Close& event) const { sink.on_close(event); }
  void operator()(const OverrideInhibit& event) const { sink.on_override_inhibit(event); }

  void give(const HeldText& event, std::string_view text) const {
    switch (event.kind) {
      case HeldText::Kind::Output:
        return sink.on_output({event.origin, event.device, text});
      case HeldText::Kind::Open:
        return sink.on_open({event.origin, event.device, {}});
      case HeldText::Kind::OpenNamed:
        return sink.on_open({event.origin, event.device, text});
      case HeldText::Kind::Message:
        return sink.on_message({event.origin, text});
    }
  }
};

inline HeldText held(const Output& event) {
  return {HeldText::Kind::Output, event.device, event.origin, 0, 0};
}
inline HeldText held(const Open& event) {
  const auto kind = event.name ? HeldText::Kind::OpenNamed : HeldText::Kind::Open;
  return {kind, event.device, event.origin, 0, 0};
}
inline HeldText held(const Message& event) {
  return {HeldText::Kind::Message, {}, event.origin, 0, 0};
}

}  // namespace dripline::interpreter::look_ahead
