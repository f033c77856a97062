#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/wire/discipline.hpp"

/// Telnet with the com port option (RFC 854, 855, 856, 2217) as a byte state machine: the client's
/// side, no socket and no clock.
namespace dripline::serial {

/// Commands of the com port option, as the client sends them; the server's answers are 100 higher.
enum class ComPort : std::uint8_t {
  Signature = 0,
  SetBaudRate = 1,  ///< 4 bytes, most significant first
  SetDataSize = 2,
  SetParity = 3,    ///< 1 none, 2 odd, 3 even, 4 mark, 5 space
  SetStopSize = 4,  ///< 1, 2, and 3 for 1.5
  SetControl = 5,
  NotifyLineState = 6,
  NotifyModemState = 7,
  FlowSuspend = 8,
  FlowResume = 9,
  SetLineStateMask = 10,
  SetModemStateMask = 11,
  PurgeData = 12,
};

/// A command with its value of at most 4 bytes.
struct ComPortCommand {
  ComPort command = ComPort::Signature;
  std::uint32_t value = 0;
  friend bool operator==(const ComPortCommand&, const ComPortCommand&) = default;
};

/// The event that one byte from the server completed.
struct LineStateSeen {
  std::optional<wire::LineFault> fault;
  friend bool operator==(const LineStateSeen&, const LineStateSeen&) = default;
};
struct FlowSeen {
  bool is_suspended = false;  ///< the server's buffer is full
  friend bool operator==(const FlowSeen&, const FlowSeen&) = default;
};
/// The setting that the server reports: the value of our command, or its own.
struct AnswerSeen {
  ComPortCommand answer;
  friend bool operator==(const AnswerSeen&, const AnswerSeen&) = default;
};
struct ComPortAgreed {
  bool is_supported = false;
  friend bool operator==(const ComPortAgreed&, const ComPortAgreed&) = default;
};
using TelnetEvent =
    std::variant<std::byte, LineStateSeen, wire::InputLines, FlowSeen, AnswerSeen, ComPortAgreed>;

/// The client's end of one connection. The owner feeds every received byte and sends the bytes of
/// `take_replies`, in order with those of `encode` and `command`. Answers to a byte are at most 3
/// bytes long, a subnegotiation longer than kMaxSub is dropped. Not thread-safe.
class Rfc2217Client {
 public:
  Rfc2217Client();  ///< the first reply opens the negotiation

  /// At most one event for each byte, so any chunking gives the same events.
  std::optional<TelnetEvent> feed(std::byte byte);
  std::vector<std::byte> take_replies() { return std::exchange(replies_, {}); }

  /// Appends the characters as they are on the network (IAC doubled) to `to`.
  void encode(std::span<const std::byte> characters, std::vector<std::byte>& to) const;
  static void encode(const ComPortCommand& command, std::vector<std::byte>& to);

  static constexpr std::size_t kMaxSub = 64;

 private:
  enum class State : std::uint8_t { Data, AfterCr, Command, Option, Sub, SubCommand };
  /// One option on one side. Only changes are answered, so that the negotiation ends.
  enum class Switch : std::uint8_t { Off, Asked, On };

  std::optional<TelnetEvent> on_data(std::uint8_t byte);
  std::optional<TelnetEvent> on_command(std::uint8_t byte);
  std::optional<TelnetEvent> on_option(std::uint8_t option);
  std::optional<TelnetEvent> on_sub_end();
  void reply(std::uint8_t verb, std::uint8_t option);

  State state_ = State::Data;
  std::uint8_t verb_ = 0;
  std::array<Switch, 256> ours_{}, theirs_{};
  std::vector<std::uint8_t> sub_;
  bool is_sub_too_long_ = false;
  std::vector<std::byte> replies_;
};

/// The commands that set up a line, in order: rate, format, flow control, requested notices. Only
/// RTS/CTS is flow control of the device server: XON/XOFF characters belong to the discipline and
/// must pass through.
std::vector<ComPortCommand> setup_commands(const wire::LineSettings& settings);
std::vector<ComPortCommand> output_line_commands(wire::OutputLines lines);
/// "baud 9600", for people.
std::string to_string(const ComPortCommand& command);

}  // namespace dripline::serial
