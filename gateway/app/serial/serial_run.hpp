#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gateway/app/command_log.hpp"
#include "gateway/app/options.hpp"
#include "gateway/app/panel/consent.hpp"
#include "gateway/app/serial/line_journal.hpp"
#include "gateway/app/serial/pulled_text.hpp"
#include "gateway/app/serial/serial_records.hpp"
#include "gateway/app/serial/serial_start.hpp"
#include "gateway/line/port_line.hpp"
#include "protocol/dds/record_text.hpp"

namespace dripline::gateway {

/// The run of a machine whose control is at the end of the gateway's own line: its text from the
/// server, its progress over the line, its counters and its end. One thread, but `on_progress`.
class SerialRun {
 public:
  struct Parts {
    const GatewayOptions& options;
    const wire::LineSettings& settings;
    std::uint64_t session = 0;
    dds::GatewayEndpoint& endpoint;
    report::Outbox& outbox;
    report::RunJournal& journal;
    SerialRecords& records;
    CommandLog& commands;
    Consent& consent;
    const Clock& clock;
  };
  /// All references must outlive it.
  explicit SerialRun(const Parts& parts) : parts_(parts), journal_(parts.journal) {}
  /// Before anything else; the line outlives the runs.
  void use(line::PortLine& port) { port_ = &port; }

  /// Ends the run of a former process as interrupted. Errors: those of the outbox.
  Result<void> recover();
  /// The run before this process was broken off: the control may be in its middle.
  bool is_program_broken() const { return is_program_broken_; }

  /// Errors: Busy (a run, the line, the disk), Timeout (no line), Unsupported, Syntax.
  Result<void> start(const dds::Command& command, SteadyTime now);
  void on_data(const dds::BlockData& data, SteadyTime now);
  void ask_again();
  void poll(SteadyTime now);
  std::optional<SteadyTime> next_poll() const;

  /// What is sent needs cycle start at the panel, or cannot be sent: the control's request, which
  /// came before it, is no consent.
  bool must_wait_for_panel() const;

  // Errors of these: Busy, Conflict.
  Result<void> cycle_start();
  Result<void> hold();
  Result<void> resume();
  /// Ends it, on the line or before it came there.
  void abort(const std::string& reason);
  /// The line is closed: what has not come there ends as interrupted.
  void interrupt(const std::string& reason);
  /// Of the line, as a task.
  void on_sent(const line::SendEnd& sent);
  /// On the line's thread.
  void on_progress(const line::SendProgress& progress) { journal_.write(progress); }

  bool is_active() const { return current_.has_value(); }
  /// Its end is staged, not yet on disk.
  bool is_ending() const { return current_ && current_->is_ending; }
  bool is_on_line() const { return current_ && current_->is_on_line; }
  const report::ActiveRun& run() const { return current_->run; }
  /// What is known of its progress; zero before it is on the line.
  line::SendProgress progress() const;
  /// Text that has come and has not left.
  std::uint64_t buffered_bytes() const;
  double seconds_of(std::uint64_t bytes) const;  ///< on the line
  /// The program is looked through for the place where the run begins; nothing has left.
  bool is_looking() const;
  std::uint64_t looked_at() const { return current_->start->looked_at(); }
  /// Held before anything of it was on the line.
  bool is_held_before_line() const { return current_ && !is_on_line() && current_->is_held; }
  /// What is sent before the program; empty: nothing.
  std::string head() const;
  /// All of its text is here.
  bool has_all_text() const;
  /// What prints belong to: the run, or the last one since this process began.
  const std::string& last_run() const { return last_run_; }
  dds::Execution last_execution() const { return last_execution_; }
  const std::string& last_message() const { return last_message_; }

 private:
  struct Current {
    report::ActiveRun run;
    std::shared_ptr<PulledText> text;
    std::optional<SerialStart> start = {};
    bool is_on_line = false, is_ending = false;
    bool is_held = false;  ///< before it was on the line: it waits for cycle start
  };
  void look_for_beginning(SteadyTime now);
  void begin(SteadyTime now);
  Result<void> check_line() const;
  void begin_on_line();
  void end(dds::RunOutcome outcome, const std::string& reason, const report::Progress& progress);
  void finish();
  std::string label() const;

  Parts parts_;
  LineJournal journal_;
  line::PortLine* port_ = nullptr;
  std::optional<Current> current_;
  bool is_program_broken_ = false;
  std::string last_run_, last_message_;
  dds::Execution last_execution_ = dds::Execution::Ready;
  SteadyTime next_sync_{};
};

/// Whether the control's operator begins a transfer there, so that its request is his consent.
bool is_begun_at_control(const wire::LineSettings& settings);

}  // namespace dripline::gateway
