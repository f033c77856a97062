#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/impl/path.hpp"
#include "gateway/machine/operator_panel.hpp"

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
  bool is_empty() const { return used_ == 0; }
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

/// The part of the panel that does not apply to an action: the program's OverrideInhibit before it.
struct Lock {
  interpreter::FeedHoldInhibit hold = interpreter::FeedHoldInhibit::AtOnce;
  bool feed_override = false, spindle_override = false, single_block = false;
  bool is_tapping = false;

  /// The panel as this action sees it. A handwheel drives the program in the place of its feeds.
  OperatorPanel seen(const OperatorPanel& panel) const {
    OperatorPanel seen = panel;
    if (feed_override || panel.handwheel) seen.feed_override = 1;
    if (panel.handwheel) seen.rapid_override = 1;
    if (spindle_override) seen.spindle_override = 1;
    if (single_block) seen.single_block = false;
    return seen;
  }
};

inline Lock lock_of(const interpreter::OverrideInhibit& event) {
  return {.hold = event.hold,
          .feed_override = event.feed_override,
          .spindle_override = event.spindle_override,
          .single_block = event.single_block,
          .is_tapping = event.is_tapping};
}

/// What the speed of a move depends on.
enum class Pace : std::uint8_t { Rapid, Feed, FeedPerRevolution, Thread };

/// One move, with what the planner needs. Speeds: mm (or degrees) per second.
struct Move {
  Path path;
  Pace pace = Pace::Rapid;
  double speed = 0;    ///< wanted at 100 %
  double ceiling = 0;  ///< what the axes allow along this path
  double acceleration = 1;
  double spindle_headroom = 1;  ///< how much faster than at 100 % the spindle could turn
  double corner_square = 0;     ///< highest speed at the start, by the corner there, squared
  double exit_square = 0;       ///< the planner's: highest speed at the end, squared

  double wanted_speed(const OperatorPanel& panel) const {
    return std::min(ceiling, asked_speed(panel));
  }
  /// Whether an axis allows less than a feed asks for.
  bool is_limited(const OperatorPanel& panel) const {
    return pace != Pace::Rapid && asked_speed(panel) > ceiling * (1 + 1e-9);
  }

 private:
  double asked_speed(const OperatorPanel& panel) const {
    if (panel.dry_run && pace != Pace::Rapid)
      return panel.dry_run_speed * panel.feed_override * path.part_of_all_axes();
    const double spindle = std::min(panel.spindle_override, spindle_headroom);
    switch (pace) {
      case Pace::Rapid:
        return speed * panel.rapid_override;
      case Pace::Feed:
        return speed * panel.feed_override;
      case Pace::FeedPerRevolution:
        return speed * panel.feed_override * spindle;
      case Pace::Thread:
        return speed * spindle;
    }
    return 0;
  }
};

struct Wait {
  double seconds = 0;
  bool follows_spindle = false;  ///< `seconds` hold at 100 % spindle
};
/// A text of the queue's ring and what it is.
struct Text {
  enum class Kind : std::uint8_t { Output, Open, OpenNamed, Message, Warning };
  Kind kind = Kind::Output;
  interpreter::OutputDevice device = interpreter::OutputDevice::File;
  TextRing::Piece piece;
  std::string_view id;  ///< warnings
  std::uint64_t line = 0;
  std::uint32_t column = 0;
};
struct BlockEnd {};     ///< for blocks whose last action was already executed, or had none
struct ProbeMarker {};  ///< the one open probe; its data is beside the queue
struct AlarmMarker {};  ///< the one alarm; its text is beside the queue
struct CloseDevice {
  interpreter::OutputDevice device = interpreter::OutputDevice::File;
};
struct CoolantChange {
  bool flood = false, mist = false;
};

using Body =
    std::variant<BlockEnd, Move, Wait, Text, ProbeMarker, AlarmMarker, CloseDevice, CoolantChange,
                 interpreter::Spindle, interpreter::ToolChange, interpreter::Miscellaneous,
                 interpreter::PinChange, interpreter::Stop, interpreter::End>;

/// One thing the machine will do.
struct Action {
  interpreter::Origin origin;
  bool ends_block = false;
  Lock lock;
  double seconds = 0;  ///< about what it takes at 100 %
  Body body;

  /// The axes are at standstill before it begins.
  bool needs_standstill() const {
    if (const auto* tool = std::get_if<interpreter::ToolChange>(&body))
      return !tool->is_preselection;
    return std::holds_alternative<Wait>(body) || std::holds_alternative<ProbeMarker>(body) ||
           std::holds_alternative<AlarmMarker>(body) ||
           std::holds_alternative<interpreter::Miscellaneous>(body) ||
           std::holds_alternative<interpreter::Stop>(body) ||
           std::holds_alternative<interpreter::End>(body);
  }
};

}  // namespace dripline::machine::impl
