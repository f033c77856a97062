#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

/// Line disciplines as byte state machines: no socket, no clock, no thread. One object is one end
/// of one line for as long as the line is open; both ends of every protocol exist.
namespace dripline::wire {

/// Since the line was opened. Time is an input.
using LineTime = std::chrono::nanoseconds;

enum class Role : std::uint8_t {
  Host,     ///< the DNC side
  Control,  ///< the machine's side
};

/// Modem lines as we see them.
struct InputLines {
  bool cts = true, dsr = true, dcd = true;
  friend bool operator==(const InputLines&, const InputLines&) = default;
};
/// Modem lines as we set them.
struct OutputLines {
  bool rts = true, dtr = true;
  friend bool operator==(const OutputLines&, const OutputLines&) = default;
};
/// The fault that the UART reports for a character.
enum class LineFault : std::uint8_t { Parity, Framing, Overrun, Break };

/// The request of one end, in protocols that have requests.
struct TransferRequest {
  enum class Kind : std::uint8_t {
    SendProgram,  ///< the other end wants a program: answer with begin_send or refuse
    TakeProgram,  ///< the other end is about to send one: begin_receive or refuse
    Directory,    ///< the other end wants the list: begin_send with the list, or refuse
  };
  Kind kind = Kind::SendProgram;
  std::string name;  ///< as the protocol names it ("15"); empty: the next program
};

struct TextReceived {
  std::string text;  ///< program text as it is stored: ASCII, LF after each block
};
struct TransferBegan {
  bool is_receiving = false;
  std::string name;  ///< if the protocol sends it
};
/// The last text of a transfer has been delivered, in a checked protocol: accepted by the other
/// end.
struct TransferEnded {
  bool is_receiving = false;
  /// Silence ended what was received, or this end did: nothing shows that its last line is whole.
  bool is_cut = false;
};
/// The other end holds us or releases us.
struct FlowChanged {
  bool is_stopped = false;
};
/// In a checked protocol: the amount of the offered text that the other end has accepted.
/// Cumulative.
struct TextAccepted {
  std::uint64_t bytes = 0;
};
/// The transfer in progress has failed. The object is idle again.
struct TransferFailed {
  Error error;
};
/// An error after which the transfer continues (a repeated block, a parity error in an unchecked
/// text, whose character was replaced by '?').
struct LineError {
  Error error;
};
/// The other end released a program that was broken off (Discipline::expect_release): it gets no
/// other one for it.
struct ReleaseRefused {
  bool is_known = false;  ///< the protocol reports to it that the program is over
};
using Event = std::variant<TextReceived, TransferBegan, TransferEnded, FlowChanged, TextAccepted,
                           TransferFailed, LineError, TransferRequest, ReleaseRefused>;

enum class Phase : std::uint8_t { Idle, Sending, Receiving, Requesting };

/// The state that a port's listing shows.
struct LineState {
  Phase phase = Phase::Idle;
  bool is_stopped = false;              ///< by the other end
  bool is_stopping = false;             ///< we hold the other end
  std::string_view waiting_for;         ///< "DC1", "ACK", "CTS", ...; empty: nothing
  bool may_wait_without_limit = false;  ///< the protocol requires it
  /// The other end's TransferRequest still waits for an answer: begin_send or refuse gives it.
  bool is_asked = false;
  /// The transfer being sent waits for the other end to begin it: none of it has left.
  bool awaits_start = false;
  /// The text being received is no transfer of this protocol, and begin_send would end it.
  bool is_stray = false;
  /// Of the text offered for the transfer being sent, or sent last: bytes whose characters have all
  /// been given to transmit's caller. Cumulative; 0 again with the next begin_send. A run counts
  /// them as sent where the protocol has no TextAccepted.
  std::uint64_t text_sent = 0;
};

/// One end of a line.
///
/// The owner (protocol/serial, or a test) calls `receive`, `fault`, `lines` and `tick` when
/// something happened; then `transmit` as often as the line accepts characters; then `take_events`.
/// `now` never decreases. Received bytes in other pieces give the same events, except for the
/// pieces of TextReceived.
///
/// Plain lines carry both directions at once: a reception may begin and end while the phase is
/// Sending, begin_send and begin_receive check only their own direction, and a failure ends both.
///
/// A TransferRequest need not be answered. It is in force until begin_send or refuse, or until the
/// other end withdraws it: DC3 where DC1 asked, EOT, silence over XMODEM, DSR off, or `abort`.
///
/// Bounds: it keeps no more text than `room()` accepts (at most 64 KiB); events are taken after
/// each call; an owner that cannot store more received text calls `set_ready(false)`. Not
/// thread-safe.
class Discipline {
 public:
  virtual ~Discipline() = default;

  // From the line
  virtual void receive(std::span<const std::byte> bytes, LineTime now) = 0;
  virtual void fault(LineFault fault, LineTime now) = 0;
  virtual void lines(InputLines lines, LineTime now) = 0;
  /// The time named by `deadline()` has come.
  virtual void tick(LineTime now) = 0;

  // To the line
  /// Puts the characters that may leave now into `room` and returns their number. The owner passes
  /// them to the driver at once and never has more than two character times in the driver, so
  /// nothing ever needs to be recalled. Control characters of this end (DC3, ACK) go first and also
  /// leave while the other end holds us.
  virtual std::size_t transmit(std::span<std::byte> room, LineTime now) = 0;
  virtual OutputLines output_lines() const = 0;
  /// When the owner must call `tick`, or `transmit` again after a pause of this end.
  virtual std::optional<LineTime> deadline() const = 0;

  // Calls of the owner
  /// Errors: Busy (a transfer is in progress), Unsupported (this protocol cannot begin here).
  virtual Result<void> begin_send(std::string_view name, LineTime now) = 0;
  /// The amount of text that `offer` accepts now.
  virtual std::size_t room() const = 0;
  /// More text of the transfer being sent: ASCII, LF after each block; at most `room()` bytes.
  /// `is_last` with the last piece, which may be empty. Errors: Syntax (a character that the line's
  /// code does not have, named with its line; the transfer has then failed), LimitExceeded (more
  /// than room()), Conflict (nothing is being sent).
  virtual Result<void> offer(std::string_view text, bool is_last, LineTime now) = 0;
  /// Expects a transfer, or answers a TakeProgram. Errors: as begin_send.
  virtual Result<void> begin_receive(std::string_view name, LineTime now) = 0;
  /// Requests a transfer of the other end (a control asks its host). Errors: Busy, Unsupported.
  virtual Result<void> request(const TransferRequest& request, LineTime now) = 0;
  /// Refuses a request; the control shows the reason where the protocol can carry it.
  virtual Result<void> refuse(std::string_view reason, LineTime now) = 0;
  /// Whether there is room for received text; without: XOFF, RTS off, a withheld ACK.
  virtual void set_ready(bool is_ready, LineTime now) = 0;
  /// Ends the transfer in progress, notifies the other end where the protocol can, and drops a
  /// waiting request of the other end. Idle afterwards.
  virtual void abort(LineTime now) = 0;
  /// A program was broken off before this object was created: the next DC1 of the other end may
  /// release that program, and is then no request for another one.
  virtual void expect_release() {}

  virtual LineState state() const = 0;
  /// The events since the last call, in order.
  virtual std::vector<Event> take_events() = 0;
};

/// Errors: Unsupported (settings that exclude each other, named).
Result<std::unique_ptr<Discipline>> make_discipline(const LineSettings& settings, Role role);

}  // namespace dripline::wire
