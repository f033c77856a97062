#pragma once

#include <functional>
#include <memory>
#include <string>

#include "protocol/serial/channel.hpp"

namespace dripline::serial {

/// What passed over the line, for monitors and the flight recorder.
struct LineTraffic {
  enum class What : std::uint8_t { Sent, Received, Fault, Lines, Note };
  What what = What::Note;
  wire::LineTime time{};             ///< since the line was opened
  std::span<const std::byte> bytes;  ///< Sent, Received; valid during the call
  std::string_view text;             ///< Fault, Lines, Note: in words
};

/// Called on the line's thread; must return soon.
struct LineListener {
  std::function<void(wire::Event&)> on_event;
  std::function<void(const LineTraffic&)> on_traffic;
  /// The channel was lost (with the reason) or is open (empty reason).
  std::function<void(const Error* lost)> on_channel;
  /// There is room for text to offer.
  std::function<void()> on_room;
};

/// Runs one discipline over one channel on a thread of its own: paces what leaves so that at most
/// two character times are ever with the driver, opens the channel anew when it was lost, and calls
/// the listener. Commands from any thread are carried out on the line's thread by `post`.
class LineDriver {
 public:
  struct Parts {
    std::string address;
    wire::LineSettings settings;
    wire::Role role = wire::Role::Host;
    LineListener listener;
    std::chrono::milliseconds reopen_after{1000};
  };
  /// Starts the thread; the channel may come later. Errors: those of make_discipline.
  static Result<std::unique_ptr<LineDriver>> start(Parts parts);
  virtual ~LineDriver() = default;  ///< stops and joins

  /// Runs `work` on the line's thread, soon.
  virtual void post(std::function<void(wire::Discipline&, wire::LineTime)> work) = 0;
  virtual wire::LineState state() const = 0;  ///< any thread
  virtual bool is_open() const = 0;           ///< any thread
};

}  // namespace dripline::serial
