#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"

/// The messages of dripline.idl as C++ values, already checked: enumerators are in range, names
/// well formed, text is UTF-8. MTConnect words where it has them. Members mean what the IDL says.
namespace dripline::dds {

/// 2: orders carry number and deadline. Gateways of other versions are shown and heard, but started
/// by nobody.
inline constexpr std::uint32_t kProtocolVersion = 2;
inline constexpr std::size_t kMaxBlockBytes = 32 * 1024;
inline constexpr std::uint32_t kMaxRequestBytes = 1024 * 1024;
inline constexpr std::size_t kMaxRecordText = 4096;

enum class Execution : std::uint8_t {
  Ready,
  Active,
  Interrupted,
  FeedHold,
  Stopped,
  ProgramStopped,
  ProgramCompleted,
  OptionalStop,
  Waiting,
};  ///< Waiting: for text (a starved feed), an answer or a connection; `message` says for what
enum class ControllerMode : std::uint8_t { Automatic, ManualDataInput, Manual };
enum class RecordKind : std::uint8_t {
  RunStarted,  ///< text: JSON {"program","revision","control"}
  RunEnded,    ///< text: JSON RunEnd, see server/machines and gateway/report
  Output,      ///< text: the line; device: where it went
  Probe,       ///< text: JSON {"to":{},"until":"","tripped":true,"at":{}}
  Message,
  Stop,
  Warning,
  Alarm,         ///< text: JSON {"code","text"}
  DeviceOpened,  ///< text: the name given, or empty
  DeviceClosed,
};
enum class CommandAction : std::uint8_t {
  Start,
  Hold,
  Resume,
  Abort,
  Answer,
  Switch,
  FeedOverride,
  RapidOverride,
  SpindleOverride,
  Handwheel,
  Refuse,  ///< no order: the server does not command this gateway; `argument` says why
};
enum class MotionKind : std::uint8_t { None, Rapid, Line, Clockwise, Counterclockwise, Thread };
enum class CompensationSide : std::uint8_t { Off, Left, Right };
enum class FeedUnit : std::uint8_t { PerMinute, PerRevolution, InverseTime };
enum class SpindleState : std::uint8_t { NotTold, Off, Clockwise, Counterclockwise, Oriented };
/// Whether the machine's side lets the network start it.
enum class RemoteEnable : std::uint8_t { NotTold, Unattended, Given, NotGiven };
/// What a run goes on with. CycleStart: at the machine's panel, or a resume where that may.
enum class WaitsFor : std::uint8_t { NotTold, Nothing, CycleStart, Text, Answer, Disk };
enum class BlockStatus : std::uint8_t { Ok, NoSuchRun, NoSuchProgram, OutOfRange, Corrupt, Failed };

std::string_view to_string(Execution value);
std::string_view to_string(ControllerMode value);
std::string_view to_string(RecordKind value);
std::string_view to_string(CommandAction value);
std::string_view to_string(BlockStatus value);
std::string_view to_string(MotionKind value);
std::string_view to_string(CompensationSide value);
std::string_view to_string(FeedUnit value);
std::string_view to_string(SpindleState value);
std::string_view to_string(RemoteEnable value);
std::string_view to_string(WaitsFor value);

struct Announce {
  std::string machine, control, version;
  std::uint32_t protocol = kProtocolVersion;
  std::uint64_t epoch = 0, session = 0;
  std::string description;
  friend bool operator==(const Announce&, const Announce&) = default;
};

inline constexpr std::size_t kMaxWorkSystem = 16;
inline constexpr std::size_t kMaxCycle = 32;

struct ActiveModes {
  MotionKind motion = MotionKind::None;
  CompensationSide compensation = CompensationSide::Off;
  bool is_inch = false, is_incremental = false;
  FeedUnit feed_unit = FeedUnit::PerMinute;
  double feed = 0;
  bool is_feed_limited = false;
  std::optional<std::int32_t> tool, next_tool, tool_offset;  ///< none is negative
  double tool_length_x = 0, tool_length_z = 0, tool_radius = 0;
  std::string work_system, cycle;
  double dwell_seconds = 0;
  bool is_surface_speed = false;
  double spindle_speed = 0;
  std::optional<double> spindle_load;
  bool flood = false, mist = false;
  std::optional<std::uint8_t> tool_axis;  ///< 0 = X, 8 = W; below nine
  SpindleState spindle = SpindleState::NotTold;
  friend bool operator==(const ActiveModes&, const ActiveModes&) = default;
};

/// What depends on the program and on what the operator has set for it.
struct ProgramFrame {
  std::array<double, 9> position{}, target{};  ///< program coordinates
  std::array<double, 9> datum{}, shift{};
  double rotation = 0, basic_rotation = 0;
  std::array<double, 3> scale{1, 1, 1};
  std::uint8_t mirrored = 0, pole_axes = 0;  ///< bit 0 = X, bit 2 = Z
  std::array<double, 3> pole{};
  friend bool operator==(const ProgramFrame&, const ProgramFrame&) = default;
};

struct Coordinates {
  std::array<double, 9> target{};  ///< machine coordinates
  std::optional<std::array<double, 9>> lag = {};
  std::optional<ProgramFrame> program = {};
  friend bool operator==(const Coordinates&, const Coordinates&) = default;
};

struct Status {
  std::string machine;
  UtcTime time;
  Execution execution = Execution::Ready;
  ControllerMode mode = ControllerMode::Automatic;
  std::string run, program;
  std::uint64_t sent = 0, accepted = 0, executed = 0, total_bytes = 0;
  std::uint64_t offset = 0, line = 0;
  std::int64_t sequence = -1;
  std::array<double, 9> position{};
  double feed_mm_per_min = 0, spindle_rpm = 0;
  double feed_override = 1, rapid_override = 1, spindle_override = 1;
  double buffered_seconds = 0;
  bool single_block = false;
  std::string message;
  std::uint32_t outbox = 0;
  std::uint16_t axes = 0;  ///< bit set over `position`, bit 0 = X
  std::uint64_t session = 0;
  std::optional<ActiveModes> modes;        ///< older gateways say none
  std::optional<Coordinates> coordinates;  ///< likewise
  bool emergency_stop = false;
  std::chrono::microseconds steady{0};  ///< 0: from an older gateway
  RemoteEnable remote_enable = RemoteEnable::NotTold;
  WaitsFor waits_for = WaitsFor::NotTold;
  friend bool operator==(const Status&, const Status&) = default;
};

struct Record {
  std::string machine;
  std::uint64_t epoch = 0, number = 0;
  UtcTime time;
  std::string run;
  RecordKind kind = RecordKind::Message;
  std::uint64_t block = 0, line = 0;
  std::int64_t sequence = -1;
  std::string device, text;
  friend bool operator==(const Record&, const Record&) = default;
};

struct RecordAck {
  std::string machine;
  std::uint64_t epoch = 0, number = 0;
  friend bool operator==(const RecordAck&, const RecordAck&) = default;
};

inline constexpr std::size_t kMaxCommandSetup = 64 * 1024;

struct Command {
  std::string machine, id;
  UtcTime expires;  ///< for gateways of protocol 1
  CommandAction action = CommandAction::Hold;
  std::string run, program, revision;
  std::uint64_t size = 0;
  std::string control, argument;
  double value = 0;
  std::uint64_t session = 0;  ///< 0: whichever gateway hears it
  std::string setup;          ///< start: TOML, at most kMaxCommandSetup; empty: the gateway's own
  std::uint64_t server = 0, number = 0;
  std::chrono::microseconds deadline{0};  ///< by the gateway's steady clock; 0: none
  friend bool operator==(const Command&, const Command&) = default;
};

struct CommandResult {
  std::string machine, id;
  bool accepted = false;
  std::string reason;
  friend bool operator==(const CommandResult&, const CommandResult&) = default;
};

struct BlockRequest {
  std::string machine;
  std::uint64_t session = 0;
  std::string run, program;
  std::uint64_t offset = 0;
  std::uint32_t length = 0;
  friend bool operator==(const BlockRequest&, const BlockRequest&) = default;
};

struct BlockData {
  std::string machine;
  std::uint64_t session = 0;
  std::string run, program;
  BlockStatus status = BlockStatus::Ok;
  std::uint64_t offset = 0, total_bytes = 0;
  bool ends = false;
  std::vector<std::byte> bytes;  ///< the CRC was right, or the message was dropped and counted
  std::string reason;
  friend bool operator==(const BlockData&, const BlockData&) = default;
};

}  // namespace dripline::dds
