#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// What a board of the Grbl 1.1 class sends, line by line. Pure; any thread.
namespace dripline::machine::grbl {

inline constexpr std::size_t kMaxAxes = 6;  ///< X Y Z A B C, or as the board states ([AXS:])

/// Values of the board's axes, in its order; `count` of them are present. Millimetres or degrees,
/// or inches where the board reports in inches ($13).
struct AxisValues {
  std::array<double, kMaxAxes> value{};
  std::size_t count = 0;
  friend bool operator==(const AxisValues&, const AxisValues&) = default;
};

enum class BoardState : std::uint8_t {
  Idle,
  Run,
  Hold,
  Jog,
  Alarm,
  Door,
  Check,
  Home,
  Sleep,
  Tool
};
std::string_view to_string(BoardState state);

/// Single bytes that a board acts on at once, outside of its lines.
inline constexpr char kAskStatus = '?', kFeedHold = '!', kCycleStart = '~', kSoftReset = '\x18',
                      kSafetyDoor = '\x84', kJogCancel = '\x85';

struct OkReply {};
struct ErrorReply {
  int code = 0;
};
struct AlarmReply {
  int code = 0;
};
/// The first line after a start or a reset.
struct Greeting {
  std::string version;  ///< "1.1f"
  bool is_grbl_hal = false;
};
/// `<Run|MPos:...|Bf:...|Ln:...|FS:...>`; what a report leaves out is absent.
struct StatusReport {
  struct Buffers {
    int free_blocks = 0;  ///< of the planner
    int free_bytes = 0;   ///< of the receive buffer
  };
  struct Overrides {
    int feed = 100, rapid = 100, spindle = 100;  ///< percent
    friend bool operator==(const Overrides&, const Overrides&) = default;
  };
  BoardState state = BoardState::Idle;
  std::optional<int> substate;
  std::optional<AxisValues> machine_position, work_position, work_offset;
  std::optional<Buffers> buffers;
  std::optional<std::uint32_t> line;  ///< N of the block that the planner executes
  std::optional<double> feed, spindle;
  std::optional<Overrides> overrides;
  std::string pins;  ///< letters of the input pins that are active

  bool rests() const;        ///< no axis moves, and none is about to
  bool leaves_door() const;  ///< after a cycle start: the axes are about to move
};
struct SettingReply {
  int number = 0;
  double value = 0;
};
/// `[OPT:letters,blocks,bytes...]` of `$I`.
struct BuildReply {
  std::string letters;
  int blocks = 0;  ///< of the planner
  int bytes = 0;   ///< of the receive buffer
};
/// `[AXS:count:letters]` of grblHAL's `$I`: its axes in the order of every list of values.
struct AxesReply {
  std::string letters;
};
struct ProbeReply {
  AxisValues at;
  bool tripped = false;
};
/// One line of `$#`: "G54" ... "G59", "G28", "G30", "G92" or "TLO".
struct OffsetReply {
  std::string name;
  AxisValues value;
};
/// `[GC:G0 G54 ...]` of `$G`.
struct ModesReply {
  std::vector<std::string> words;
};
struct NoticeReply {
  std::string text;  ///< of [MSG:...]
};
/// A line of the protocol that this back end has no use for: [VER:...], [HLP:...], an empty line.
struct UnusedReply {};
/// Not a line of the protocol.
struct GarbageReply {
  std::string text;  ///< its beginning
};

using Reply = std::variant<OkReply, ErrorReply, AlarmReply, Greeting, StatusReport, SettingReply,
                           BuildReply, AxesReply, ProbeReply, OffsetReply, ModesReply, NoticeReply,
                           UnusedReply, GarbageReply>;

/// `line` without its end. A number that is none, or a report with a member that does not parse, is
/// GarbageReply: never a value that the board did not send.
Reply parse_reply(std::string_view line);

/// Collects lines from bytes in any pieces. A line over kMaxLine is given as its first kMaxLine
/// bytes, which parse as garbage.
class LineSplitter {
 public:
  static constexpr std::size_t kMaxLine = 512;
  /// The lines that `bytes` complete.
  std::vector<std::string> feed(std::span<const std::byte> bytes);
  void reset() { line_.clear(), is_too_long_ = false; }

 private:
  std::string line_;
  bool is_too_long_ = false;
};

}  // namespace dripline::machine::grbl
