#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

/// The enumerations of message.hpp and the words that stand for them in JSON.
/// Values are MTConnect's where it has them. New enumerators go to the end: their numbers are on
/// the wire.
namespace dripline::dds {

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

}  // namespace dripline::dds
