#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "protocol/base/shared.hpp"
#include "protocol/dds/message.hpp"
#include "server/library/releases.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// What is known of a machine: the stored part and what its gateway reported last.
struct MachineView {
  storage::Machine machine;
  bool is_connected = false;
  std::uint64_t session = 0;  ///< of the gateway heard last; commands go to this one
  bool is_contested = false;  ///< two gateways claim to be this machine
  /// Another gateway that is not taken for the machine's until someone confirms it: its version.
  std::optional<std::string> unconfirmed_gateway = {};
  /// Its gateway is connected, but no status of it arrives: what is shown is what was.
  bool is_stale = false;
  std::optional<UtcTime> status_taken = {};  ///< when the last status arrived
  /// Switches that keep the machine from moving and were on at the gateway before this one, which
  /// begins without them: "test_run"; empty: none, or something has run since.
  std::string lost_switches = {};
  /// Null until one was received since the server started. Shared by all copies of a view: it has
  /// two dozen texts, and a thousand machines are looked at five times a second.
  Shared<dds::Status> status;
  std::optional<std::uint32_t> protocol;  ///< of its gateway; absent: not announced, or on a line
  std::uint32_t commands = 0;             ///< dds::Announce::commands
  /// How far the gateway's time of day is ahead of the server's; absent: not known yet.
  std::optional<std::chrono::microseconds> clock_ahead = {};
  std::optional<UtcTime> certificate_expires = {};  ///< of its gateway; absent: it has none
  /// Why it is in feed hold, and why its queue starts nothing (HeldMachines).
  std::optional<storage::MachineHold> held = {};
  std::optional<storage::JobHold> queue_hold = {};

  /// What is shown is what is: its gateway is connected, and its statuses arrive.
  bool is_heard() const { return is_connected && !is_stale; }
  /// Its gateway says that its control is at the end of a line.
  bool has_gateway_line() const { return status && status->serial_line; }
  /// Its control is at the end of a line, of the server's or of its gateway's: no setup goes with a
  /// start, and which one it has is known by word alone (SetupStore::loaded).
  bool has_serial_line() const { return machine.gateway_version.empty() || has_gateway_line(); }
};

/// Where a run begins when it does not begin at the program's first byte. At most one is given.
/// Over a serial line `skipped` is Unsupported. A gateway executes the program
/// without motion up to there; a control whose interpreter cannot do that refuses.
struct StartPoint {
  std::optional<std::uint64_t> byte;      ///< offset; the rest of its block is sent first
  std::optional<std::uint64_t> line;      ///< 1-based
  std::optional<std::uint64_t> sequence;  ///< the first block with this N number
  std::optional<std::uint64_t> tool;      ///< the first block that changes to this tool
  std::optional<std::uint64_t> skipped;   ///< after so many blocks
  /// Which pass, from 1, where the program reaches that block more than once. A gateway's control
  /// asks for it; over a serial line Unsupported.
  std::optional<std::uint64_t> pass = {};
};

/// Over a serial line, what becomes of the words before the beginning that the rest relies on
/// (units, feed, tool ...).
enum class StartHead : std::uint8_t {
  Ask,   ///< the run is refused, and they are named
  Send,  ///< they are sent first
  Set,   ///< the operator confirms that they are in force at the control
};

/// Which memory of the control (variables, offsets) a gateway executes the skipped part with, where
/// that part changes what it has read before. Over a serial line Unsupported.
enum class StartMemory : std::uint8_t {
  Ask,    ///< the run is refused, and what it would lose is named
  Begin,  ///< as it was when the machine's last run of this revision began at its first block
  Now,    ///< as it is: the skipped part applies again
};

/// A run that was cut off and is to continue: the gateway rebuilds the state from its checkpoints.
struct RestartRequest {
  std::string run;
  /// executed, block=1234, L7 (line), N120, T3 (tool), time=2026-11-23T15:04:05Z; the gateway reads
  /// it.
  std::string at = "executed";
};

struct StartRequest {
  std::string machine;
  std::string program;
  std::optional<std::uint64_t> revision;  ///< absent: the latest
  std::string author;
  storage::Role role = storage::Role::Viewer;  ///< of the author; a control that asks has none
  StartPoint from = {};
  StartHead head = StartHead::Ask;
  StartMemory memory = StartMemory::Ask;
  bool is_test = false;  ///< a test run, which moves nothing; only at a gateway
  std::optional<RestartRequest> restart = {};  ///< then nothing of the four before
  std::optional<SteadyTime> given = {};        ///< to the server; absent: now
  bool is_mdi = false;  ///< the program was keyed in for this run; only at a gateway
  std::optional<std::uint64_t> job = {};  ///< of the machine's queue, that it is a run of
  /// Called when the run is stored and nothing has gone to the machine. Its error refuses the run.
  std::function<Result<void>(const storage::Run&)> before = {};
  /// Called when it was accepted and its operator has to know something of how it begins.
  std::function<void(const std::string& notice)> on_notice = {};

  library::Releases::Wish wish() const {
    return {.machine = machine, .program = program, .revision = revision, .role = role};
  }
};

struct CommandRequest {
  std::string run;  ///< empty: for `machine`, with a run or without
  dds::CommandAction action = dds::CommandAction::Hold;  ///< any but Start
  std::string argument;                                  ///< answer: its text; switch: its name
  double value = 0;                                      ///< overrides: factor; switch: 0 or 1
  std::string machine = {};                              ///< where `run` is empty: its panel
  /// Of a hold: shown with the machine while it is held.
  std::string who = {}, reason = {};
  std::optional<SteadyTime> given = {};  ///< to the server; absent: now
};

/// Which values of a control are asked for.
struct ValueQuery {
  std::string machine;
  std::string beginning;          ///< of their names; empty: all
  std::uint64_t passed_over = 0;  ///< of the values with such a name
};

/// What is taken over from where the axes of a machine at rest are.
struct PositionRequest {
  std::string machine;
  std::string argument;  ///< interpreter::to_text(PositionSetting); playback: letters of axes
  std::string who;
  bool is_playback = false;              ///< asks for the words of a block, and changes nothing
  std::optional<SteadyTime> given = {};  ///< to the server; absent: now
};
struct PositionAnswer {
  std::string change;  ///< which its record names instead of a run; empty: nothing was changed
  std::string text;    ///< what is set, or the block
  /// What is set, as JSON (gateway/app/memory/position_change.hpp); empty: an older gateway.
  std::string details = {};
};

/// One axis of a machine without a run by one step.
struct JogRequest {
  std::string machine;
  std::string move;                      ///< interpreter::to_text(JogMove), or keep_text
  std::optional<SteadyTime> given = {};  ///< to the server; absent: now
};
struct JogAnswer {
  std::string text;     ///< where the axis is now, and why it has not come further
  std::string details;  ///< the same as JSON: axis, position, moved, unit, reached
};

/// Receives what happens at the machines. Called on worker threads, never two calls for one machine
/// at once; must return soon.
struct MachineListener {
  std::function<void(const MachineView&)> on_machine;
  std::function<void(const storage::Run&)> on_run;
  std::function<void(const storage::Record&)> on_record;
};

/// Where the command of a run goes.
struct CommandTarget {
  std::string machine;
  std::string program;  ///< empty: not looked up
};

struct MachinePage {
  std::string after;  ///< a name; empty: from the first one
  std::size_t limit = 0;
};

/// The machines as the API sees them. Any thread; `start` and `command` wait for the gateway's
/// answer, at most some seconds.
class MachineControl {
 public:
  virtual ~MachineControl() = default;
  /// In order of their names.
  virtual std::vector<MachineView> machines() const = 0;
  /// Of those the first ones whose name is after this one.
  virtual std::vector<MachineView> machines_after(const MachinePage& page) const;
  /// Errors: NotFound.
  virtual Result<MachineView> machine(const std::string& name) const = 0;
  /// Which machine reports this run as its own now; without the store, so that a stop needs none.
  virtual std::optional<std::string> machine_of_run(const std::string& run) const;
  /// Returns the run when the gateway has accepted it. Errors: NotFound (machine, program,
  /// revision), Unsupported (the program is for another control; `head` for a gateway), Conflict
  /// (the rest of the program relies on what is not sent; nothing of it may run there), Busy (the
  /// machine has a run, or the gateway refused: the run's state is then Refused), Timeout (not
  /// connected, or no answer in time).
  virtual Result<storage::Run> start(const StartRequest& request) = 0;
  /// Errors: NotFound (run, machine), Conflict (it has ended), Busy (refused, with the
  /// gateway's reason), Timeout (not connected, or no answer in time: the outcome is unknown).
  virtual Result<void> command(const CommandRequest& request) = 0;
  /// What its control's variables, offsets and outputs are now, as the gateway's JSON
  /// (gateway/app/memory/control_values.hpp); changes nothing. Errors: NotFound, Unsupported (a
  /// control at the end of a line, an older gateway), Timeout (not connected, no answer in time).
  virtual Result<std::string> values(const ValueQuery& query) = 0;
  /// Sets a datum or a tool's length in the control's memory, or asks for a position; nothing
  /// moves. Errors: as for values, Busy (refused, with the gateway's reason).
  virtual Result<PositionAnswer> position(const PositionRequest& request) = 0;
  /// Returns when the axis rests, at most some 20 s later. Errors: likewise; Timeout also where its
  /// gateway was replaced meanwhile: whether the axis has moved is not known then.
  virtual Result<JogAnswer> jog(const JogRequest& request) = 0;
  /// The gateway that waits with another memory than the one before becomes the machine's, though a
  /// run may be in progress. Returns what it is, for people. Errors: NotFound, Conflict (none
  /// waits).
  virtual Result<std::string> confirm_gateway(const std::string& machine);
  /// A machine that is no more there: it is listed no more, what refers to it stays. One that
  /// announces itself again is there again. Errors: NotFound, Busy (connected, or with a run that
  /// has not ended), Conflict (it has a port, or jobs in its queue).
  virtual Result<void> remove(const std::string& machine, const storage::Actor& who);
};

}  // namespace dripline::machines
