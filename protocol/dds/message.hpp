#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"

/// The messages of dripline.idl as C++ values, already checked: enumerators are in range, names are
/// well formed, text is UTF-8. Words and values are MTConnect's where it has them; dripline.idl
/// states the meaning of each member. A new member also gets its row in members.hpp, from which
/// encoding, decoding, checks and the JSON of the API come.
namespace dripline::dds {

/// 2: commands carry number and deadline. A gateway of another version is shown, and its records
/// are stored, but the server starts no program there.
inline constexpr std::uint32_t kProtocolVersion = 2;
/// The argument of a start whose text is keyed in (MDI). A gateway that does not know it refuses
/// its second word.
inline constexpr std::string_view kMdiStart = "mdi keyed-in";
/// The argument of an abort that stops a jog and nothing else.
inline constexpr std::string_view kJogAbort = "jog";
/// Records of a change that an operator has set name no run, but this and the command's id.
inline constexpr std::string_view kChangePrefix = "set-";
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
};  ///< Waiting: for text (a starved feed), an answer or a connection; `message` names which
enum class ControllerMode : std::uint8_t { Automatic, ManualDataInput, Manual };
enum class RecordKind : std::uint8_t {
  RunStarted,  ///< text: JSON {"program","revision","control"}
  RunEnded,    ///< text: JSON RunEnd (record_text.hpp)
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
  Refuse,  ///< the server does not command this gateway; `argument` is the reason
  Query,   ///< asks for values of the control, and changes nothing; needs a gateway with a Screen
  SetPosition,  ///< a datum or a tool's length from where the axes are; moves nothing
  Playback,     ///< asks for the position as words of a block, and changes nothing
  Jog,          ///< one axis by a finite step, without a program
};
enum class MotionKind : std::uint8_t { None, Rapid, Line, Clockwise, Counterclockwise, Thread };
enum class CompensationSide : std::uint8_t { Off, Left, Right };
enum class FeedUnit : std::uint8_t { PerMinute, PerRevolution, InverseTime };
enum class SpindleState : std::uint8_t { Unknown, Off, Clockwise, Counterclockwise, Oriented };
/// The position that a control's screen shows, where its operator chooses one.
enum class PositionDisplay : std::uint8_t {
  Unknown,
  Actual,     ///< in program coordinates
  Reference,  ///< on the machine
  FollowingError,
  Nominal,  ///< where the move ends, in program coordinates
  DistanceToGo,
};
/// Whether the machine's side lets the network start it.
enum class RemoteEnable : std::uint8_t { Unknown, Unattended, Given, NotGiven };
/// The event that continues a run. CycleStart: at the machine's panel, or a resume command where
/// that is permitted.
enum class WaitsFor : std::uint8_t { Unknown, Nothing, CycleStart, Text, Answer, Disk };
/// Unknown: the control or the machine has no such switch.
enum class SwitchState : std::uint8_t { Unknown, Off, On };
enum class BlockStatus : std::uint8_t { Ok, NoSuchRun, NoSuchProgram, OutOfRange, Corrupt, Failed };

/// As wire::Phase.
enum class LinePhase : std::uint8_t { Idle, Sending, Receiving, Requesting };
/// What an operator requests at a control: by a rule, or by the protocol itself.
enum class LineCallAction : std::uint8_t {
  Send,       ///< a program, by a rule
  Directory,  ///< the list of programs, by a rule
  Restart,    ///< the last run again, by a rule
  Program,    ///< by the protocol: it waits for the answer, or for a run
  List,       ///< by the protocol: the list
  NextJob,    ///< a run of the next job in the machine's queue, by a rule
};
enum class LineAction : std::uint8_t {
  Recording,  ///< entries of the recording from `number` on, as JSON lines
  Upload,     ///< bytes of the upload `name` from `number` on
  Stored,     ///< the upload `name` is on disk; `text` is for the operator at the control
  Answer,     ///< send the text `name` to answer the call `number`; `text`: line::TransferOrder
  Refuse,     ///< refuse the call `number`; `text` is the reason
  Done,       ///< the call `number` was carried out
  Test,       ///< examine the line; the answer has the findings, one a line
  Receive,    ///< have the control send a program
  Text,       ///< keep `bytes` from `number` on of the text `name`; from 0 on another one begins
  Send,       ///< send the text `name`; `text` is a line::TransferOrder
  Stop,       ///< end a transfer that is no run; `text` is the reason
  Judge,      ///< judge `bytes` by the rules; the answer has the verdict
};
/// As line::TransferState.
enum class LineTransferState : std::uint8_t { Sending, Completed, Aborted, Interrupted };
enum class LineResult : std::uint8_t { Done, Refused, NotYet };

/// The words of an enumeration, in the order of its enumerators; a value from the network is in
/// range when it has a word.
std::span<const std::string_view> words_of(Execution);
std::span<const std::string_view> words_of(ControllerMode);
std::span<const std::string_view> words_of(RecordKind);
std::span<const std::string_view> words_of(CommandAction);
std::span<const std::string_view> words_of(BlockStatus);
std::span<const std::string_view> words_of(MotionKind);
std::span<const std::string_view> words_of(CompensationSide);
std::span<const std::string_view> words_of(FeedUnit);
std::span<const std::string_view> words_of(SpindleState);
std::span<const std::string_view> words_of(PositionDisplay);
std::span<const std::string_view> words_of(RemoteEnable);
std::span<const std::string_view> words_of(WaitsFor);
std::span<const std::string_view> words_of(SwitchState);
std::span<const std::string_view> words_of(LinePhase);
std::span<const std::string_view> words_of(LineCallAction);
std::span<const std::string_view> words_of(LineAction);
std::span<const std::string_view> words_of(LineTransferState);
std::span<const std::string_view> words_of(LineResult);

template <class T>
concept Enumeration = requires(T value) {
  words_of(value);
};

std::string_view to_string(Enumeration auto value) {
  return words_of(value)[static_cast<std::size_t>(value)];
}

struct Announce {
  std::string machine, control, version;
  std::uint32_t protocol = kProtocolVersion;
  std::uint64_t epoch = 0, session = 0;
  std::string description;
  std::optional<UtcTime> certificate_expires = {};  ///< the gateway's, for DDS Security
  bool has_line = false;       ///< its machine is a control at the end of a line
  std::uint32_t commands = 0;  ///< how many values of CommandAction it knows; 0: an older gateway
  friend bool operator==(const Announce&, const Announce&) = default;
};

inline constexpr std::size_t kMaxWorkSystem = 16;
inline constexpr std::size_t kMaxCycle = 32;
inline constexpr std::size_t kMaxBlockText = 128;  ///< of a screen

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
  SpindleState spindle = SpindleState::Unknown;
  friend bool operator==(const ActiveModes&, const ActiveModes&) = default;
};

/// Program coordinates and how they lie on the machine.
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
  std::optional<std::array<double, 9>> following_error = {};
  std::optional<ProgramFrame> program = {};
  friend bool operator==(const Coordinates&, const Coordinates&) = default;
};

struct PanelSwitches {
  SwitchState optional_stop = SwitchState::Unknown, block_skip = SwitchState::Unknown;
  std::string skip_levels;  ///< those from 2 on that are skipped: "2,9"
  SwitchState dry_run = SwitchState::Unknown, machine_lock = SwitchState::Unknown;
  SwitchState handwheel = SwitchState::Unknown;
  friend bool operator==(const PanelSwitches&, const PanelSwitches&) = default;
};

/// A program that a control has sent, on the gateway's disk.
struct LineUpload {
  std::string id, name;
  std::uint64_t size = 0;
  std::string content, damage;
  friend bool operator==(const LineUpload&, const LineUpload&) = default;
};

struct LineCall {
  std::uint64_t number = 0;
  LineCallAction action = LineCallAction::Send;
  std::string argument, reply;
  friend bool operator==(const LineCall&, const LineCall&) = default;
};

struct LineTransfer {
  std::string id, programs;
  std::uint64_t size = 0, sent = 0;
  LineTransferState state = LineTransferState::Sending;
  std::string reason;
  friend bool operator==(const LineTransfer&, const LineTransfer&) = default;
};

struct LineAsked {
  UtcTime since;
  std::string program, answer;
  friend bool operator==(const LineAsked&, const LineAsked&) = default;
};

struct LineStatus {
  std::string address, line_template, settings;
  bool is_open = false;
  std::string fault;
  LinePhase phase = LinePhase::Idle;
  bool is_stopped = false, is_stopping = false, waits_without_limit = false;
  std::string waiting_for;
  std::uint64_t characters_sent = 0, characters_received = 0, buffered_bytes = 0;
  std::optional<LineUpload> upload;
  std::optional<LineCall> call;
  std::optional<LineTransfer> transfer;
  std::optional<LineAsked> asked;
  std::optional<UtcTime> waiting_since;
  std::uint64_t recorded = 0;  ///< 0: from an older gateway
  friend bool operator==(const LineStatus&, const LineStatus&) = default;
};

/// Texts of blocks are empty where there is none, or it is not shown, or not at hand.
struct Screen {
  bool is_inch = false;
  PositionDisplay position = PositionDisplay::Unknown;
  std::string previous_block = {}, block = {}, next_block = {}, further_block = {};
  friend bool operator==(const Screen&, const Screen&) = default;
};

/// Of a machine that can be jogged.
struct JogStatus {
  double step = 0, feed = 0;  ///< the largest, mm or degrees; per minute. No step: none is allowed
  bool is_moving = false;
  std::string refusal;  ///< why none can begin now; empty: one can
  friend bool operator==(const JogStatus&, const JogStatus&) = default;
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
  std::optional<ActiveModes> modes;        ///< none from an older gateway
  std::optional<Coordinates> coordinates;  ///< likewise
  bool emergency_stop = false;
  std::chrono::microseconds steady{0};  ///< 0: from an older gateway
  RemoteEnable remote_enable = RemoteEnable::Unknown;
  WaitsFor waits_for = WaitsFor::Unknown;
  std::optional<LineStatus> serial_line;  ///< of a gateway beside a control
  std::optional<Screen> screen;           ///< none from an older gateway, nor of such a control
  std::optional<PanelSwitches> switches;  ///< none from an older gateway
  std::optional<JogStatus> jog;           ///< likewise, nor of a machine that is not jogged
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
  std::uint64_t term = 0;  ///< of the server, set by its endpoint; 0: none
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
  std::uint64_t session = 0;  ///< 0: any gateway of the machine
  std::string setup;          ///< start: TOML, at most kMaxCommandSetup; empty: the gateway's own
  std::uint64_t server = 0, number = 0;
  std::chrono::microseconds deadline{0};  ///< by the gateway's steady clock; 0: none
  std::uint64_t term = 0;                 ///< of the server, set by its endpoint; 0: none
  friend bool operator==(const Command&, const Command&) = default;
};

struct CommandResult {
  std::string machine, id;
  bool accepted = false;
  std::string reason;
  std::string values = {};  ///< of a query: JSON, at most kMaxCommandSetup
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
  std::vector<std::byte> bytes;  ///< a message with a wrong CRC was dropped
  std::string reason;
  std::string content;     ///< of a called program: its SHA-256, hexadecimal; empty: not stated
  std::uint64_t term = 0;  ///< of the server, set by its endpoint; 0: none
  friend bool operator==(const BlockData&, const BlockData&) = default;
};

struct LineRequest {
  std::string machine;
  std::uint64_t session = 0;
  std::string id;
  LineAction action = LineAction::Recording;
  std::string name = {};
  std::uint64_t number = 0;
  std::string text = {};              ///< at most kMaxCommandSetup
  std::vector<std::byte> bytes = {};  ///< a message with a wrong CRC was dropped
  std::uint64_t term = 0;             ///< of the server, set by its endpoint; 0: none
  friend bool operator==(const LineRequest&, const LineRequest&) = default;
};

struct LineData {
  std::string machine;
  std::uint64_t session = 0;
  std::string id;
  LineResult status = LineResult::Done;
  std::uint64_t next = 0;
  bool ends = true;
  std::vector<std::byte> bytes = {};  ///< a message with a wrong CRC was dropped
  std::string reason = {};
  friend bool operator==(const LineData&, const LineData&) = default;
};

}  // namespace dripline::dds
