#pragma once

#include <algorithm>
#include <variant>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/impl/lock.hpp"
#include "gateway/machine/impl/path.hpp"
#include "gateway/machine/impl/text_ring.hpp"
#include "gateway/machine/operator_panel.hpp"

namespace dripline::machine::impl {

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
