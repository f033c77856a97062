#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "protocol/serial/line_driver.hpp"
#include "protocol/wire/discipline.hpp"

/// What can be seen of a line in use.
namespace dripline::line {

/// In the order in which they are sent; of a reception only Receiving is no end.
enum class TransferState : std::uint8_t { Sending, Completed, Aborted, Interrupted, Receiving };
std::string_view to_string(TransferState state);

/// Programs sent as they are, without a run: the last such transfer of a port.
struct PortTransfer {
  std::string id = {};
  std::vector<std::string> programs = {};  ///< names, in their order
  std::uint64_t size = 0, sent = 0;        ///< bytes; what passed the line for certain
  std::uint64_t at_most = 0;               ///< bytes that may have passed it
  TransferState state = TransferState::Sending;
  std::string reason = {};                        ///< why it was not completed, for people
  std::optional<UtcTime> began = {}, ended = {};  ///< where they are known
};

/// What outlives the one who uses a line.
struct LineMemory {
  std::optional<PortTransfer> transfer = {};  ///< the last one that did not go through
  /// The control may be in the middle of a text, of whatever kind: its next request may be for the
  /// rest of that (Discipline::expect_release).
  bool may_be_in_text = false;
};

/// What the control asked for last, while no run waited for it.
struct PortRequest {
  UtcTime since;
  std::string program;  ///< as the protocol named it; empty: whichever is ready
  std::string answer;   ///< why it was refused; empty: it still waits, a run would begin at once
};

/// Whose line it is.
struct PortNames {
  std::string name, machine, address;
};

/// A line as it is now.
struct LineView {
  PortNames names;
  wire::LineSettings settings;  ///< effective: template, then the port's own
  bool is_open = false;         ///< the channel is there
  std::string fault;            ///< why not, or the last fault; for people
  wire::LineState line;
  std::string run;  ///< being sent, may be empty
  std::optional<PortTransfer> transfer;
  std::optional<PortTransfer> reception;  ///< the last program that came, where it is known
  std::uint64_t sent = 0;                 ///< characters since the line was opened
  std::uint64_t received = 0;
  std::optional<UtcTime> waiting_since;  ///< of a wait that the protocol does not limit
  std::optional<PortRequest> request;    ///< until it is taken back, or something is sent
};

using TrafficKind = serial::LineTraffic::What;
std::string_view to_string(TrafficKind kind);
/// Errors: Syntax.
Result<TrafficKind> parse_traffic_kind(std::string_view text);

/// One thing on a line: what monitors show and the flight recorder keeps.
struct PortTraffic {
  std::string port;
  UtcTime time;
  TrafficKind what = TrafficKind::Note;
  std::string bytes;  ///< Sent and Received: as they were
  std::string text;   ///< the others: in words
};

}  // namespace dripline::line
