#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/app/command_validity.hpp"
#include "gateway/app/consent.hpp"
#include "gateway/app/execution_recorder.hpp"
#include "gateway/app/inbox.hpp"
#include "gateway/app/options.hpp"
#include "gateway/app/run_session.hpp"
#include "gateway/app/start_argument.hpp"
#include "gateway/feed/control_line.hpp"
#include "gateway/feed/line_feed.hpp"
#include "gateway/report/record_sender.hpp"
#include "gateway/report/status_publisher.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::gateway {

/// One machine's gateway: takes orders, runs programs, reports. Everything happens in `turn`, on
/// one thread; messages come in as values, time as an argument. Without a server it goes on with
/// the text it has, keeps its records, and takes up where it was when a server is back.
class Gateway {
 public:
  struct Parts {
    const GatewayOptions& options;
    const interpreter::Dialect& dialect;
    interpreter::Setup setup;
    dds::GatewayEndpoint& endpoint;
    report::Outbox& outbox;
    report::RunJournal& journal;
    ExecutionProbe& execution_probe;
    const Clock& clock;
    machine::MotionFactory make_motion;  ///< of what moves the machine
    std::uint64_t session = 0;           ///< of this process, not zero
    feed::ControlLine* line = nullptr;   ///< where programs come from instead of the server
  };
  /// All references must outlive it.
  explicit Gateway(Parts parts);

  /// Before the first turn: ends the run that a former process was busy with as interrupted at the
  /// block it executed last. Errors: those of the outbox; Unsupported (a speed that the machine
  /// does not have).
  Result<void> recover();

  void receive(Incoming incoming, SteadyTime now);
  /// Does what is due, for at most about kSlice; returns when to be called again, if nothing comes
  /// in before.
  SteadyTime turn(SteadyTime now);
  bool stop_requested() const { return stop_requested_; }

  /// Ends the run, if any, as interrupted. Errors: those of the outbox; then the next start does
  /// it.
  Result<void> interrupt_run(const std::string& reason);
  /// Nothing left to send.
  bool is_delivered() const { return outbox_.unacknowledged() == 0 && results_.empty(); }

  static constexpr std::chrono::milliseconds kSlice{8};  ///< of work between two looks at the inbox
  static constexpr std::chrono::milliseconds kTick{10};  ///< while the machine moves in real time
  static constexpr std::chrono::milliseconds kLongestStep{100};  ///< real time never jumps by more

 private:
  struct Reply {
    bool is_accepted = true;
    std::string reason;
  };
  static Reply refuse(std::string reason) { return {false, std::move(reason)}; }

  // gateway_commands.cpp
  void on_command(const dds::Command& command);
  void on_refusal(const dds::Command& command);
  bool stops(const dds::Command& command) const;
  Reply carry_out(const dds::Command& command, bool is_stop);
  Reply start(const dds::Command& command);
  struct StartedBy {
    std::string command;      ///< what is answered; empty: nobody
    std::string setup;        ///< what the server knows of tools, offsets and variables, TOML
    StartArgument from = {};  ///< where it begins; without a place at the beginning
  };
  Result<void> begin_run(const report::ActiveRun& run, std::unique_ptr<feed::ProgramFeed> feed,
                         const StartedBy& started_by);
  Result<interpreter::Setup> setup_with(const std::string& control_data) const;
  std::optional<Reply> refusal_of_start(const dds::Command& command);
  Reply operate(const dds::Command& command);
  void keep_result(const dds::Command& command, const Reply& reply);
  void answer(const dds::Command& command, const Reply& reply);
  void send_results();

  // gateway_panel.cpp
  void take_panel_tables(const interpreter::Setup& setup);
  Reply set_switch(const dds::Command& command);
  Reply set_emergency_stop(bool is_pressed);
  Reply set_override(const dds::Command& command);
  std::optional<std::string> refusal_of_feed(double factor) const;
  std::optional<std::string> refusal_of_spindle(double factor) const;
  Reply turn_handwheel(const dds::Command& command);

  // gateway_consent.cpp
  /// Why an order that came over the network is not carried out for now.
  std::optional<Reply> refusal_without_consent(const dds::Command& command) const;
  void on_panel(const PanelRequest& request);
  Reply carry_out_at_panel(const PanelCommand& command);
  Reply set_remote_enable(bool is_enabled);
  Reply set_emergency_stop_at_panel(bool is_pressed);
  Reply cycle_start();
  Reply discard_memory();
  std::string panel_status() const;
  bool wait_for_cycle_start(SteadyTime now);
  dds::RemoteEnable remote_enable() const;
  dds::WaitsFor waits_for(const dds::Status& status) const;

  // gateway_run.cpp
  void run_slice(SteadyTime now);
  bool run_round(double& machine_seconds, SteadyTime& deadline);
  void commit_reports();
  void keep_memory();
  void report_memory();
  bool wait_out_fault(SteadyTime now);
  void judge_end();
  void end_run(dds::RunOutcome outcome, const std::string& reason);
  void try_to_finish(SteadyTime now);

  // gateway_line.cpp
  void serve_line(SteadyTime now);
  void take_line_item(feed::LineItem& item);
  bool is_of_next_run(const feed::LineItem& item) const;
  void take_line_text(std::string_view text);
  void line_text_ended();
  void line_failed(const std::string& reason);
  bool begin_line_run();
  void listen(bool may_ask);
  void line_run_over();
  void release_line();
  void print_on_line(const interpreter::Output& output);

  // gateway_status.cpp
  dds::Status status() const;
  dds::ActiveModes modes(const machine::MachineStatus& now) const;
  dds::Coordinates coordinates(const machine::MachineStatus& now) const;
  void fill_execution(dds::Status& status) const;
  dds::Execution execution_of_run(std::string& message) const;

  void announce();
  void log_rejected(SteadyTime now);
  SteadyTime next_turn(SteadyTime now) const;
  bool is_running() const;
  std::string label() const;

  Parts parts_;
  report::Outbox& outbox_;
  ExecutionRecorder recorder_;
  ControlMemory memory_;
  std::unique_ptr<machine::MotionBackend> motion_;
  machine::MotionBackend& machine_;
  report::RecordSender sender_;
  report::StatusPublisher publisher_;
  std::unique_ptr<RunSession> session_;
  CommandValidity validity_;
  interpreter::PanelTables panel_tables_;
  Consent consent_;
  bool is_stopped_at_panel_ = false;  ///< the emergency stop was pressed there

  std::deque<dds::CommandResult> results_;
  bool announcement_is_due_ = true, is_connected_ = false, stop_requested_ = false;
  bool is_ending_ = false;              ///< the run's last records are staged, not yet on disk
  bool is_held_by_fault_ = false;       ///< not by the operator
  bool was_emergency_stopped_ = false;  ///< the run; it ends when the switch is released
  SteadyTime last_step_{}, next_commit_{}, next_sync_{}, next_rejected_log_{};
  std::uint64_t rejected_logged_ = 0;
  dds::Execution last_execution_ = dds::Execution::Ready;
  std::string last_message_;
  std::string refused_by_server_;  ///< why it does not command this gateway

  /// What is done with text from the line.
  enum class Line : std::uint8_t {
    Closed,     ///< nothing was asked of it yet
    Listening,  ///< it begins a run
    Feeding,    ///< it is the run's
    Complete,   ///< none is expected: the run's text is complete, or broke off
    Draining,   ///< it is what a run that is over left on the way, and dropped
  } line_ = Line::Closed;
  feed::LineFeed* line_feed_ = nullptr;  ///< of session_
  std::uint64_t line_released_ = 0;      ///< of its text
  std::string line_program_, line_fault_;
  std::string line_request_;  ///< still to be asked for; "next": always
  std::optional<SteadyTime> listen_at_;
  std::vector<feed::LineItem> held_items_;  ///< of the next run: the emergency stop is pressed
};

}  // namespace dripline::gateway
