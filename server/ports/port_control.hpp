#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/line/inbound/rule_set.hpp"
#include "gateway/line/line_examination.hpp"
#include "gateway/line/port_view.hpp"
#include "protocol/base/result.hpp"
#include "storage/store.hpp"

namespace dripline::ports {

using line::parse_traffic_kind;
using line::PortRequest;
using line::PortTest;
using line::PortTraffic;
using line::PortTransfer;
using line::RuleVerdict;
using line::to_string;
using line::TrafficKind;
using line::TransferState;

/// A program that is to be sent; without a number the latest revision.
struct ProgramChoice {
  std::string program;
  std::optional<std::uint64_t> revision;
};
inline constexpr std::size_t kMaxTransferPrograms = 256;

/// A port as it is configured; kept in the store (storage::Port). `settings` are pairs of
/// wire::setting_rows() keys and values over those of `line_template`.
struct PortView : line::LineView {
  storage::Port port;
};

/// The serial ports as the API sees them. Any thread.
class PortControl {
 public:
  virtual ~PortControl() = default;
  virtual std::vector<PortView> ports() const = 0;
  /// Errors: NotFound.
  virtual Result<PortView> port(const std::string& name) const = 0;
  /// Adds or changes one; an open line is closed and opened again. Errors: Syntax, LimitExceeded,
  /// NotFound (template, setting key), Unsupported (settings that exclude each other; a protocol
  /// that the control of the machine's setup has not), Busy (it has a run; or the address is
  /// another port's, named).
  virtual Result<PortView> save(const storage::Port& port) = 0;
  /// Errors: NotFound, Busy (it has a run).
  virtual Result<void> remove(const std::string& name) = 0;
  /// Opens the line if necessary and reports what can be found without a program: modem lines, XOFF
  /// held, stray characters. At most some seconds. Errors: NotFound, Busy.
  virtual Result<PortTest> test(const std::string& name) = 0;
  /// Sends programs to the control as one text, as they stand and without a run: a control that
  /// takes programs into its memory has them then. Several must bear O numbers; the whole is framed
  /// as the line's settings say. Returns when the line has taken the job; `port` shows its
  /// progress. Errors: NotFound (port, program), Conflict (held, or may not run there), Unsupported
  /// (another control's; several on a line whose protocol names one; a protocol as of `save`),
  /// Syntax (no number), LimitExceeded, Busy, Timeout; those of ResetGate::check.
  virtual Result<PortTransfer> send(const std::string& name,
                                    const std::vector<ProgramChoice>& programs) = 0;
  /// A person has reset the control, which was in the middle of a program that was broken off:
  /// the next one is sent to it. Returns what was broken off. Errors: NotFound, those of
  /// ResetGate::confirm.
  virtual Result<std::string> confirm_reset(const std::string& name) = 0;
  /// Asks the control for a program, over a protocol whose receiver begins (XMODEM), for about two
  /// minutes; what comes is a held revision. Errors: NotFound, Unsupported (others send unasked),
  /// Busy, Timeout.
  virtual Result<void> receive(const std::string& name) = 0;
  /// Ends a transfer in either direction that is no run. Errors: NotFound, Conflict (there is
  /// none), Timeout.
  virtual Result<void> stop_transfer(const std::string& name, const std::string& reason) = 0;
  /// Judges a text by the port's rules without doing anything. Errors: NotFound.
  virtual Result<RuleVerdict> test_rules(const std::string& name,
                                         const std::string& text) const = 0;
  /// What the flight recorder still has, oldest first. Errors: NotFound.
  virtual Result<std::vector<PortTraffic>> recording(const std::string& name) const = 0;
  /// Called for everything on every line from now on: a few times a second on the machines'
  /// strands, at last by who closes a line; never on a line's own thread, one call at a time.
  /// One listener; an empty function ends it.
  virtual void on_traffic(std::function<void(const PortTraffic&)> listener) = 0;
};

}  // namespace dripline::ports
