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
#include "protocol/dds/enumerations.hpp"

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
  SwitchState handwheel = SwitchState::Unknown, test_run = SwitchState::Unknown;
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
  std::chrono::microseconds given{
      0};  ///< when the server got it, by the gateway's steady clock; 0: not known
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
