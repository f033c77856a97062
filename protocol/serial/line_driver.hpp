#pragma once

#include <functional>
#include <memory>
#include <string>

#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// The traffic of a line, for monitors and the flight recorder.
struct LineTraffic {
  enum class What : std::uint8_t { Sent, Received, Fault, Lines, Note };
  What what = What::Note;
  wire::LineTime time{};             ///< since the line was opened
  std::span<const std::byte> bytes;  ///< Sent, Received; valid during the call
  std::string_view text;             ///< Fault, Lines, Note: the text
};

/// Called on the line's thread; must return soon.
struct LineListener {
  std::function<void(wire::Event&)> on_event;
  std::function<void(const LineTraffic&)> on_traffic;
  /// The channel was lost or cannot be opened (with the reason; once for each), or is open
  /// (nullptr).
  std::function<void(const Error* lost)> on_channel;
  /// There is room for more text.
  std::function<void()> on_room;
  /// The channel has been open for Parts::steady_after; once for each opening that lasts.
  std::function<void()> on_steady = {};
};

/// Runs one discipline over one channel on a thread of its own: paces the output so that at most
/// two character times are ever in the driver, reopens a lost channel, and calls the listener.
/// `post` runs work of any thread on the line's thread.
///
/// The characters in the driver are lost with the channel. Checked protocols (XMODEM, HEIDENHAIN
/// with BCC) detect that and repeat them when the channel is back, or give up by their own limits;
/// where they wait without a limit (a TNC's ACK), and in all other protocols, a transfer in
/// progress fails (TransferFailed, code Io), and its owner decides.
class LineDriver {
 public:
  struct Parts {
    std::string address;
    wire::LineSettings settings = {};
    wire::Role role = wire::Role::Host;
    LineListener listener = {};
    std::chrono::milliseconds reopen_after{1000};
    /// A device server that has another client ends a connection within its first seconds.
    std::chrono::milliseconds steady_after{10000};
    /// Limit of one attempt to connect; posted work waits meanwhile.
    std::chrono::milliseconds open_limit{2000};
    /// False: another one may use the line, so it is not opened, and nothing is sent. Asked often,
    /// on the line's thread. Empty: it is ours alone.
    std::function<bool()> may_transmit = {};
    /// For tests, instead of wire::make_discipline and open_channel.
    std::function<std::unique_ptr<wire::Discipline>()> make_discipline = {};
    std::function<Result<std::unique_ptr<Channel>>()> open = {};
  };
  /// Starts the thread; the channel may be opened later. Errors: those of make_discipline.
  static Result<std::unique_ptr<LineDriver>> start(Parts parts);
  virtual ~LineDriver() = default;  ///< stops and joins

  /// Runs `work` on the line's thread, soon, in the order of posting; also while there is no
  /// channel. Work that still waits when the driver ends is dropped.
  virtual void post(std::function<void(wire::Discipline&, wire::LineTime)> work) = 0;
  /// Ends the thread and closes the channel; work that waits is dropped. `state` is what was then:
  /// nothing was sent since. Not from the line's thread. The destructor does the same.
  virtual void stop() = 0;
  virtual wire::LineState state() const = 0;  ///< any thread
  virtual bool is_open() const = 0;           ///< any thread
};

}  // namespace dripline::serial
