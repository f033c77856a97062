#pragma once

#include <deque>
#include <optional>
#include <string>

#include "gateway/machine/grbl/board_info.hpp"
#include "gateway/machine/grbl/character_counter.hpp"
#include "gateway/machine/grbl/execution_tracker.hpp"
#include "gateway/machine/grbl/override_sender.hpp"
#include "gateway/machine/streamed/device.hpp"

namespace dripline::machine::grbl {

/// What the line must carry.
struct BoardOutput {
  bool drops_lines = false;  ///< first: lines that have not left yet must never leave
  std::string real_time;     ///< next: overtakes the lines that have not left
  std::string lines;
};

/// Times after which the board is not what it was.
struct SessionLimits {
  std::chrono::milliseconds poll{100}, idle_poll{250};
  std::chrono::milliseconds wake{6000};    ///< an opened board answers
  std::chrono::milliseconds answer{3000};  ///< to a line, while the board is at rest
  std::chrono::milliseconds hold_after{3000}, lost_after{6000};  ///< of silence
  std::chrono::milliseconds stall{30'000};                       ///< in Run without motion
  std::chrono::milliseconds brake{10'000};                       ///< from a feed hold to rest
  std::chrono::milliseconds emergency_brake{500};
  std::chrono::milliseconds homing{180'000};  ///< most boards report nothing meanwhile
  std::size_t bytes_per_second = 256 * 1024;
  int garbage = 3;  ///< lines that are none, in one program
};

/// The conversation with one board: wakes and identifies it, counts characters, polls its status,
/// and stops it. A pure state machine: bytes and times come in, bytes come out.
///
/// Nothing that moves is ever sent by itself: motion comes by `send`, and leaves a feed hold only
/// by `resume`. After a fault the board is held and reset, which drops what it had, and then
/// nothing is sent until `restart`.
class BoardSession final : public streamed::Device {
 public:
  explicit BoardSession(SessionLimits limits = {}) : limits_(limits) {}

  // -- the line -----------------------------------------------------------------------------------
  void opened(SteadyTime now);
  void lost(const std::string& reason);
  void receive(std::span<const std::byte> bytes, SteadyTime now);
  void tick(SteadyTime now);
  /// Bounded by the board's buffer and a few real-time bytes.
  BoardOutput take_output() { return std::exchange(output_, {}); }
  /// The board is silent or gives no sense: the line should be opened again.
  bool wants_reopen() const { return wants_reopen_; }
  /// Not after a fault: opening a port resets many boards.
  bool may_open() const { return !fault_; }
  /// Why the board is not ready; empty: it is.
  const std::string& not_ready() const { return not_ready_; }

  // -- Device: the program ------------------------------------------------------------------------
  const streamed::TextRules& rules() const override { return rules_; }
  Result<void> check_ready() const override;
  void set_active(bool is_active, SteadyTime now) override;
  bool prepare(SteadyTime now) override;
  bool may_send(std::size_t bytes) const override;
  std::uint64_t send(const std::string& text, bool moves,
                     std::chrono::milliseconds longest) override;
  void await_execution() override {}
  std::uint64_t executed() const override { return tracker_.executed(); }
  bool is_empty() const override { return counter_.unanswered_lines() == 0 && tracker_.is_empty(); }
  bool is_at_rest() const override { return report_ && report_->state == BoardState::Idle; }
  const Coordinates& position() const override { return position_; }
  bool keeps_position() const override { return keeps_position_; }
  PositionTrust position_trust() const override { return trust_; }
  void drop_probe() override { probe_.reset(); }
  std::optional<streamed::ProbeEnd> probe() const override;
  void raise(std::string_view id, std::string text, SteadyTime now) override;
  const std::optional<streamed::DeviceFault>& fault() const override { return fault_; }

  // -- Device: the operator -----------------------------------------------------------------------
  void hold(SteadyTime now) override;
  bool resume(SteadyTime now) override;
  bool is_held() const override { return is_held_; }
  bool is_resuming() const override { return is_resuming_; }
  bool needs_operator() const override { return has_seen_door_; }
  /// Feed hold, then a soft reset at rest: the position is kept.
  void stop(bool is_emergency, SteadyTime now) override;
  /// Until a report shows where the reset board is. A board with a fault is believed nothing more.
  bool is_stopping() const override {
    return !fault_ && (stop_ != Stop::None || (phase_ == Phase::Ready && !report_));
  }
  /// Resets and identifies a board with a fault again.
  void restart(SteadyTime now) override;
  OperatorPanel known(OperatorPanel panel) const override { return OverrideSender::known(panel); }
  void set_overrides(const OperatorPanel& panel) override { overrides_.want(panel); }
  bool has_overrides() const override { return overrides_.is_in_force(); }
  Result<void> home(SteadyTime now) override { return reference(true, now); }
  bool is_homing() const override { return homing_limit_ && reference_ == PositionTrust::Homed; }
  /// A soft reset: a board that homes obeys nothing else.
  void stop_homing(SteadyTime now) override;
  Result<void> unlock(SteadyTime now) override { return reference(false, now); }
  std::string hold_reason() const override;
  /// `$J=`, which changes no mode of the board; stopped by its own real-time byte.
  Result<void> jog(const Jog& jog, SteadyTime now) override;
  bool is_jogging() const override { return jog_.has_value(); }
  void stop_jog(SteadyTime now) override;
  std::string jog_fault() const override { return jog_fault_; }
  void switch_off() override;
  bool is_connected() const override;
  bool has_switched_off() const override {
    return is_off_ || (off_line_ > 0 && tracker_.executed() >= off_line_);
  }

  // -- Device: what it does -----------------------------------------------------------------------
  bool is_moving() const override;
  double feed_per_minute() const override;
  double spindle_rpm() const override;
  bool input(int) const override { return false; }  ///< boards of this class have none for programs
  std::vector<std::pair<std::string, bool>> inputs() const override;

 private:
  enum class Phase : std::uint8_t { Closed, Waking, Resetting, Identifying, Ready, Silent };
  enum class Stop : std::uint8_t { None, Wake, Abort, Emergency, Fault };
  /// The modes that all lines rely on.
  enum class Preamble : std::uint8_t { None, Sent, Asked, Done };

  void on(const OkReply&, SteadyTime now);
  void on(const ErrorReply& error, SteadyTime now);
  void on(const AlarmReply& alarm, SteadyTime now);
  void on(const Greeting& greeting, SteadyTime now);
  void on(const StatusReport& report, SteadyTime now);
  void on(const SettingReply& setting, SteadyTime) { info_.take(setting); }
  void on(const BuildReply& build, SteadyTime) { info_.take(build); }
  void on(const AxesReply& axes, SteadyTime) { info_.take(axes); }
  void on(const OffsetReply& offset, SteadyTime) { info_.take(offset); }
  void on(const ProbeReply& probe, SteadyTime now);
  void on(const ModesReply& modes, SteadyTime) { modes_ = modes; }
  void on(const NoticeReply&, SteadyTime) {}
  void on(const UnusedReply&, SteadyTime) {}
  void on(const GarbageReply& garbage, SteadyTime now);

  static constexpr std::chrono::milliseconds kObeys{20};  ///< until a byte's effect is reported
  void real_time(char byte) { output_.real_time += byte; }
  void send_hold();
  void continue_stop(const StatusReport& report, SteadyTime now);
  void send_system(const std::string& text);
  bool check_modes(SteadyTime now);
  bool door_is_open() const;
  /// Homes the axes ($H), or unlocks an alarm without homing ($X). Errors: Busy (no board, a fault,
  /// a program, not at rest).
  Result<void> reference(bool is_homing, SteadyTime now);
  void drop_output() { output_ = {.drops_lines = true, .real_time = {}, .lines = {}}; }
  void identify_next(SteadyTime now);
  void begin_stop(Stop stop, std::chrono::milliseconds brake, SteadyTime now);
  void reset_board(SteadyTime now);
  void drop_lines();
  void end_homing(SteadyTime now);
  void lose_position();
  void cancel_jog(SteadyTime now);
  void end_jog(std::string fault);
  bool take_jog_answer(const std::string& line, SteadyTime now);
  void watch_jog(const StatusReport& report, SteadyTime now);
  bool has_every_axis(const StatusReport& report) const;
  void take_position(const StatusReport& report);
  void watch_state(const StatusReport& report, SteadyTime now);
  void watch_motion(const StatusReport& report, SteadyTime now);
  void ask(SteadyTime now);
  void watch_silence(SteadyTime now);
  void watch_answers(SteadyTime now);
  void step_overrides(SteadyTime now);
  void give_up(std::string reason);

  SessionLimits limits_;
  Phase phase_ = Phase::Closed;
  Stop stop_ = Stop::None;
  Preamble preamble_ = Preamble::None;
  BoardInfo info_;
  streamed::TextRules rules_;
  LineSplitter splitter_;
  CharacterCounter counter_;
  ExecutionTracker tracker_;
  OverrideSender overrides_;
  BoardOutput output_;

  std::optional<StatusReport> report_;
  Coordinates position_{};
  bool has_position_ = false;
  bool keeps_position_ = false;   ///< since the last program began, or the line was opened
  bool is_new_line_ = false;      ///< nothing was reported over it yet
  bool awaits_greeting_ = false;  ///< after a reset of ours whose end is not waited for
  PositionTrust trust_ = PositionTrust::Reconnected;
  PositionTrust reference_ = PositionTrust::Lost;  ///< that homing or unlocking leads to
  std::optional<AxisValues> work_offset_;
  std::optional<ModesReply> modes_;
  std::string work_system_;  ///< that the program's lines are in
  std::optional<ProbeReply> probe_;
  std::optional<streamed::DeviceFault> fault_;
  struct JogInHand {
    bool is_answered = false;  ///< the board has it: a report made since shows it
    std::optional<SteadyTime> cancelled_at;
  };
  std::optional<JogInHand> jog_;
  std::string jog_fault_;
  std::string last_alarm_;  ///< its number and text, for the operator
  std::string not_ready_ = "the board is not connected";

  bool is_active_ = false, is_held_ = false, is_resuming_ = false;
  bool is_off_ = false;         ///< it has greeted after a reset, and no line was sent since
  std::uint64_t off_line_ = 0;  ///< the last line, where that switches off; 0: it does not
  bool has_seen_door_ = false;  ///< since the hold began
  bool hold_is_sent_ = false, cycle_start_is_sent_ = false, wants_reopen_ = false;
  std::size_t identified_ = 0;  ///< commands of the identification that are answered
  int garbage_ = 0;

  SteadyTime phase_began_{}, next_poll_{}, asked_at_{}, stop_limit_{}, reported_at_{},
      second_began_{}, moved_at_{};
  std::optional<SteadyTime> unanswered_poll_, resting_since_, homing_limit_;
  std::chrono::milliseconds longest_{};
  std::size_t bytes_in_second_ = 0;
  Coordinates moved_to_{};
};

}  // namespace dripline::machine::grbl
