#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gateway/machine/streamed/text_rules.hpp"

namespace dripline::machine::linuxcnc {

using streamed::Coordinates;
using streamed::kMaxAxes;

/// What LinuxCNC states about itself, once. In its own units.
struct HelloReply {
  std::string version;
  double units_per_mm = 1;
  std::uint32_t axes = 0;  ///< a bit for each, X first
  std::array<double, kMaxAxes> low{}, high{};
  std::array<double, kMaxAxes> velocity{}, acceleration{};  ///< per second; 0: unknown
  double max_rpm = 0;                                       ///< 0: unknown
  std::uint32_t wrapped = 0;                                ///< axes that count to 360 degrees only
  int read_ahead = 0;                                       ///< [TASK]INTERP_MAX_LEN
  std::string startup_code;                                 ///< [RS274NGC]RS274NGC_STARTUP_CODE
  bool is_adaptive = false;                                 ///< after it: adaptive feed is on (M52)
  std::string settings;  ///< that are on and make it read programs otherwise than ours are
};

/// Numbers of LinuxCNC's interface.
enum class TaskState : std::uint8_t { Estop = 1, EstopReset = 2, Off = 3, On = 4 };
enum class InterpreterState : std::uint8_t { Idle = 1, Reading = 2, Paused = 3, Waiting = 4 };

/// Its state at one instant. Lengths in its own units.
struct StatusReply {
  TaskState state{};
  InterpreterState interpreter{};
  std::uint64_t read = 0;    ///< the line that was read last
  std::uint64_t motion = 0;  ///< the line whose motion is executed; 0: none
  std::uint64_t queue = 0;   ///< moves that are not ended
  bool is_in_position = false, is_paused = false, is_homed = false, is_homing = false;
  bool has_offset = false;  ///< the work system in force, G92, tool length or a rotation
  int work_system = 0;      ///< 1: G54 .. 9: G59.3
  Coordinates at{};         ///< as commanded
  double velocity = 0;      ///< per second
  int tool = 0;
  double spindle_rpm = 0;
  bool is_adaptive = false;  ///< M52
  bool is_touching = false;  ///< the probe, now
  bool is_tripped = false;   ///< by the last probe move
  Coordinates probed{};
  std::uint32_t inputs = 0, inputs_above = 0;  ///< a bit for each: 0 to 31, 32 to 63
  friend bool operator==(const StatusReply&, const StatusReply&) = default;
};
/// A command was handed over. `problem` is empty, or why it was not.
struct DoneReply {
  std::uint64_t number = 0;
  std::string problem;
};
/// What LinuxCNC shows to its operator; 1 and 11 are errors, the others messages.
struct MessageReply {
  int kind = 0;
  std::string text;
  bool is_error() const { return kind == 1 || kind == 11; }
};
/// A HAL pin that was asked for. Without a value: why.
struct SignalReply {
  std::string name;
  std::optional<double> value;
  std::string problem;
};
/// The helper ends.
struct FatalReply {
  std::string text;
};
struct GarbageReply {
  std::string text;
};
using HelperReply = std::variant<HelloReply, StatusReply, DoneReply, MessageReply, SignalReply,
                                 FatalReply, GarbageReply>;

/// One line without its end. Every number is finite and within its limits, or the line is garbage.
HelperReply parse_helper_reply(std::string_view line);

/// Cuts bytes into lines. A line longer than kMaxLine is cut there: both parts are garbage.
class HelperLines {
 public:
  static constexpr std::size_t kMaxLine = 16 * 1024;
  std::vector<std::string> feed(std::span<const std::byte> bytes);
  void reset() { part_.clear(); }

 private:
  std::string part_;
};

}  // namespace dripline::machine::linuxcnc
