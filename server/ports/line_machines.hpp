#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/machines/machine_control.hpp"
#include "server/machines/stop_order.hpp"
#include "server/ports/line_records.hpp"
#include "server/ports/line_runs.hpp"
#include "server/ports/programs/broken_program.hpp"

namespace dripline::ports {

/// The machines at the ends of lines: a run is a program sent over its machine's line. `connected`
/// means that the line is open; a line reports nothing of the machine itself, so its status is made
/// of what the line does. What is shown needs no store: it is shown when a machine is stopped.
class LineMachines final : public machines::MachineControl {
 public:
  using Started = std::function<void(const Result<storage::Run>&)>;
  /// How long `start` and `command` wait for the line's thread.
  static constexpr std::chrono::seconds kAnswerLimit{10};

  LineMachines(const machines::RunSources& sources, const LineDirectory& directory,
               const machines::MachineListener& listener, const ResetGate& resets);

  /// The machine has a line from now on; `stored` is how the store has it.
  void enter(const storage::Machine& stored);
  std::vector<machines::MachineView> machines() const override;
  /// Errors: NotFound (no enabled port has it).
  Result<machines::MachineView> machine(const std::string& name) const override;
  /// Needs no store.
  std::optional<std::string> machine_of_run(const std::string& run) const override;
  bool has(const std::string& machine) const { return directory_.line_of(machine) != nullptr; }
  /// Errors also: those of ResetGate::check.
  Result<storage::Run> start(const machines::StartRequest& request) override;
  /// Hold, Resume and Abort; others are Unsupported.
  Result<void> command(const machines::CommandRequest& request) override;
  Result<std::string> values(const machines::ValueQuery& query) override;
  Result<machines::PositionAnswer> position(const machines::PositionRequest& request) override;
  Result<machines::JogAnswer> jog(const machines::JogRequest& request) override;

  /// The same as `start` for callers that must not wait: `started` is called on the machine's
  /// strand. Without `given` the control asks for it by its protocol, and waits. `wire_name` is
  /// what the control calls the program; empty: as the library does.
  void start_later(const machines::StartRequest& request, Started started,
                   const std::string& wire_name = "");
  /// On the strand of that line. `stored`: the run's end is in the store.
  void on_sent(const std::string& machine, const SendEnd& end, std::function<void()> stored = {});
  void on_change(const std::string& machine);
  void save_progress(const PortLine& line);
  LineRuns& runs() { return runs_; }
  const ResetGate& resets() const { return resets_; }
  /// Notifies the listener of the run as it is stored now.
  void announce(const std::string& run) const;

 private:
  struct Start {
    machines::StartRequest request;
    Started started;
    SteadyTime given;  ///< to the server
    std::string wire_name = {};
    bool is_awaited = false;  ///< the control waits for it, however long
  };
  void post_start(Start start);
  void begin(const std::shared_ptr<PortLine>& line, const Start& start);
  /// Gives the line the job, if it is still wanted. Errors: Busy (it waited too long), Conflict (a
  /// stop was given later).
  Result<void> send(PortLine& line, const Start& start, const storage::Run& run, SendJob job);
  Result<storage::Run> conclude(const storage::Run& run, const Result<void>& begun);
  /// Errors: as of `send`; Unsupported.
  Result<void> order(PortLine& line, const machines::CommandRequest& request,
                     const PortLine::Answer& answered);
  machines::MachineView view_of(const PortLine& line) const;
  /// What is shown of a machine that its line does not know.
  struct Shown {
    storage::Machine machine;
    std::string run, program;  ///< the last run
  };
  Shown shown(const std::string& machine) const;
  void show_run(const storage::Run& run);
  struct CommandTarget {
    std::string machine, program;  ///< program: for the log; empty where it is not known
  };
  Result<CommandTarget> target_of(const std::string& run) const;

  const storage::Store& store_;
  const Clock& clock_;
  const LineDirectory& directory_;
  const machines::MachineListener& listener_;
  const ResetGate& resets_;
  LineRuns runs_;
  mutable std::mutex mutex_;
  std::map<std::string, Shown> shown_;
  std::mutex order_mutex_;
  machines::StopOrder stops_;
};

/// All machines of the server, however they are fed: those with an enabled port over their line,
/// all others by their gateway. A machine has one feeder: while a gateway speaks for one that has a
/// port, the machine is contested and nothing is started.
class MachineRouter final : public machines::MachineControl {
 public:
  MachineRouter(storage::RunStore& runs, machines::MachineControl& gateways, LineMachines& lines)
      : runs_(runs), gateways_(gateways), lines_(lines) {}

  std::vector<machines::MachineView> machines() const override;
  std::vector<machines::MachineView> machines_after(
      const machines::MachinePage& page) const override;
  Result<machines::MachineView> machine(const std::string& name) const override;
  /// Needs no store.
  std::optional<std::string> machine_of_run(const std::string& run) const override;
  Result<storage::Run> start(const machines::StartRequest& request) override;
  Result<void> command(const machines::CommandRequest& request) override;
  Result<std::string> values(const machines::ValueQuery& query) override;
  Result<machines::PositionAnswer> position(const machines::PositionRequest& request) override;
  Result<machines::JogAnswer> jog(const machines::JogRequest& request) override;
  Result<std::string> confirm_gateway(const std::string& machine) override {
    return gateways_.confirm_gateway(machine);
  }
  Result<void> remove(const std::string& machine, const storage::Actor& who) override;

 private:
  using Views = std::vector<machines::MachineView>;
  static Views merged(Views gateways, Views lines);

  storage::RunStore& runs_;
  machines::MachineControl& gateways_;
  LineMachines& lines_;
};

}  // namespace dripline::ports
