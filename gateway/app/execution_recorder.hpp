#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "gateway/app/execution_probe.hpp"
#include "gateway/app/run/run_texts.hpp"
#include "gateway/machine/execution_sink.hpp"
#include "gateway/report/motion_journal.hpp"
#include "gateway/report/outbox.hpp"
#include "gateway/report/run_journal.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::gateway {

/// Records what the machine has done, in the sequence that makes the executed counter exact:
/// a block that reported something is executed only when its records are committed. Reports
/// without motion between them share one commit; before the next motion they are on disk.
/// While a commit fails (a full disk) the counter waits, and nothing is lost: `commit` tries again.
/// One thread: the machine's owner.
class ExecutionRecorder final : public machine::ExecutionSink {
 public:
  struct Parts {
    std::string machine;
    report::Outbox& outbox;
    report::RunJournal& journal;
    report::MotionJournal* motion_journal = nullptr;  ///< null: the machine is never ahead
    ExecutionProbe& execution_probe;
    const Clock& clock;
    /// Receives what is printed at a device, besides the record; may be empty.
    std::function<void(const interpreter::Output&)> on_output = {};
  };
  explicit ExecutionRecorder(const Parts& parts) : parts_(parts) {}

  /// The other two counters, and the hash of the path up to that block, read when a block is
  /// executed.
  struct FeedProgress {
    std::uint64_t sent = 0, accepted = 0, path = 0;
    std::optional<double> path_mm = {};  ///< its length; absent: not known
  };
  using ProgressOf = std::function<FeedProgress(std::uint64_t block)>;
  /// A new run; its RunStarted record is staged, not committed. `setup`: SHA-256 of the gateway's
  /// own setup, empty: it has none.
  void begin(const report::ActiveRun& run, const std::string& setup, ProgressOf feed_progress);
  /// The run continues another after this block; to be committed.
  void continue_after(const interpreter::Origin& origin);
  /// Stages the run's end; its counters and place are filled in here. To be followed by `commit`
  /// until that succeeds; then `finish`.
  void end(dds::RunEndText end);
  void finish();
  /// The run that was begun last could not be kept: it does not exist. Nothing refers to its feed.
  void cancel();
  /// Stages the end of a run that a former process was executing, after what the control had kept.
  void end_interrupted(const std::string& run, const report::Progress& progress,
                       const std::vector<std::string>& memory);

  /// Commits what is staged, and advances the counter. Errors: those of the outbox.
  Result<void> commit();
  /// Why the last commit failed; empty when it did not.
  const std::string& fault() const { return fault_; }
  /// At a block's end (records of half a block are not yet committed).
  bool is_between_blocks() const { return is_between_blocks_; }
  const report::Progress& executed() const { return counted_; }
  /// By the machine; some of it may wait for the disk.
  const report::Progress& reached() const { return reached_; }

  /// The probe that has ended since the last call.
  std::optional<interpreter::Probe> take_probed() { return std::exchange(probed_, std::nullopt); }
  const std::optional<interpreter::Diagnostic>& alarm() const { return alarm_; }
  bool has_ended() const { return has_ended_; }
  bool was_aborted() const { return was_aborted_; }
  /// Outputs that programs have switched since the gateway began, as executed blocks left them.
  using Outputs = std::map<std::pair<interpreter::Axis, int>, bool>;
  const Outputs& switched() const { return switched_; }
  /// Analog outputs that programs have set since the gateway began (M67, M68).
  const std::map<int, double>& analog() const { return analog_; }
  /// An M function with its words, where the control hands them on.
  struct Function {
    int code = 0;
    std::optional<double> e = {}, p = {}, q = {};
  };
  /// M functions handed to the machine, the last one first; at most kMaxCodes.
  const std::deque<Function>& functions() const { return functions_; }
  static constexpr std::size_t kMaxCodes = 16;

  /// Text of the last stop or message, for the operator.
  const std::string& notice() const { return notice_; }
  void clear_notice() {
    notice_.clear();
    message_.clear();
  }

  void on_given(const machine::GivenAction& action) override;
  void on_block_executed(const interpreter::Origin& origin) override;
  bool on_motion_starts(const interpreter::Origin& origin) override;
  void on_output(const interpreter::Output& output) override;
  void on_open(const interpreter::Open& open) override;
  void on_close(const interpreter::Close& close) override;
  void on_message(const interpreter::Message& message) override;
  void on_warning(const interpreter::Warning& warning) override;
  void on_probed(const interpreter::Probe& probe) override;
  void on_pin(const interpreter::PinChange& pin) override;
  void on_miscellaneous(const interpreter::Miscellaneous& function) override;
  void on_stop(const interpreter::Stop& stop) override;
  void on_alarm(const interpreter::Alarm& alarm) override;
  void on_end(const interpreter::End& end) override;
  void on_aborted() override;
  /// The operator pressed the emergency stop while the block of `origin` was executed.
  void note_emergency_stop(const interpreter::Origin& origin);
  /// Something was done at the machine's panel, with a run or without.
  void note_at_panel(const interpreter::Origin& origin, const std::string& text);
  /// Likewise over the network.
  void note(const interpreter::Origin& origin, const std::string& text);

  /// The memory of the control, JSON: a message with a device name of its own.
  void note_memory(const std::string& text);
  static constexpr const char* kMemoryDevice = "memory";
  /// Likewise after a change by an operator, without a run: `change` names it.
  void note_memory_change(const std::string& change, const std::vector<std::string>& texts);
  /// What a restart has rebuilt, JSON, likewise.
  void note_restart(const std::string& text);
  static constexpr const char* kRestartDevice = "restart";

  static constexpr std::size_t kMaxBatch = 256;

 private:
  struct Report {
    dds::RecordKind kind = dds::RecordKind::Message;
    std::string device, text;
  };
  void append(const interpreter::Origin& origin, Report report);
  void append_end(dds::RunEndText end);
  interpreter::Origin reached_origin() const;
  void count();

  Parts parts_;
  std::string run_;
  ProgressOf feed_progress_;
  report::Progress reached_;       ///< by the machine
  report::Progress counted_;       ///< in journal and outbox
  std::optional<double> path_mm_;  ///< of the executed blocks
  std::uint64_t outputs_ = 0;
  bool is_between_blocks_ = true;
  std::string fault_, notice_, message_;
  std::optional<interpreter::Probe> probed_;
  std::optional<interpreter::Diagnostic> alarm_;
  bool has_ended_ = false, was_aborted_ = false;
  Outputs switched_;
  std::map<int, double> analog_;
  std::deque<Function> functions_;
};

}  // namespace dripline::gateway
