#pragma once

#include <deque>

#include "gateway/machine/linuxcnc/helper_reply.hpp"
#include "gateway/machine/streamed/device.hpp"

namespace dripline::machine::linuxcnc {

struct SessionLimits {
  std::chrono::milliseconds start{15'000};   ///< the helper introduces itself
  std::chrono::milliseconds silence{6'000};  ///< of the helper, which waits for no command
  std::chrono::milliseconds answer{6'000};   ///< a program is opened, an abort has come to rest
  std::chrono::milliseconds pause{3'000};    ///< until the axes rest
  std::chrono::milliseconds reason{150};     ///< for LinuxCNC's message, when it has stopped
  std::chrono::milliseconds stall{30'000};   ///< without any change
  std::chrono::milliseconds flush{5}, dry{30};
  std::chrono::milliseconds still{100}, late{500};  ///< a jog has ended: at its end, before it
  std::size_t bytes_per_second = 1024 * 1024;
  std::size_t lines_ahead = 400;  ///< sent and not executed
  /// Motion ahead of the axes, without the time that they need to come to rest: it continues when
  /// nothing is left that could stop it.
  double seconds_ahead = 0.75;
  int garbage = 3;  ///< lines of the helper that are none
};

/// The conversation with a running LinuxCNC: commands and status through a helper process, motion
/// as text through a FIFO that LinuxCNC reads as its program. A pure state machine: what the helper
/// reports and times come in; commands and text come out.
///
/// Executed is what LinuxCNC reports: the line in motion ends those before it, and a line after a
/// marker (M66) is not read before everything up to the marker is executed.
class Session final : public streamed::Device {
 public:
  explicit Session(SessionLimits limits = {}) : limits_(limits) {}

  // -- the link -----------------------------------------------------------------------------------
  void opened(SteadyTime now);
  void lost(const std::string& reason);
  void receive(std::span<const std::byte> bytes, SteadyTime now);
  /// `is_dry`: LinuxCNC has taken all of the text. Then it waits for the next line and does nothing
  /// else meanwhile, so empty lines follow as long as a program is open.
  void tick(SteadyTime now, bool is_dry);
  std::string take_commands() { return std::exchange(commands_, {}); }
  /// Whole lines for the FIFO. To be written before the commands.
  std::string take_text() { return std::exchange(text_, {}); }
  /// A FIFO is needed, from `feed_opened` until this ends.
  bool wants_feed() const { return feed_ != Feed::None; }
  bool has_feed() const { return feed_ > Feed::Wanted; }
  /// LinuxCNC has opened the FIFO: its name is needed no more.
  bool is_reading() const { return feed_ >= Feed::Reading; }
  void feed_opened(const std::string& path, SteadyTime now);
  /// Why the helper should be started again; empty: it should not.
  const std::string& reopen_reason() const { return reopen_reason_; }

  // -- Device -------------------------------------------------------------------------------------
  const streamed::TextRules& rules() const override { return rules_; }
  Result<void> check_ready() const override;
  void set_active(bool is_active, SteadyTime now) override;
  bool prepare(SteadyTime now) override;
  bool may_send(std::size_t bytes) const override;
  std::uint64_t send(const std::string& line, bool moves,
                     std::chrono::milliseconds longest) override;
  void await_execution() override;
  std::uint64_t executed() const override { return executed_; }
  bool is_empty() const override { return in_flight_.empty(); }
  bool is_at_rest() const override;
  bool finish(SteadyTime now) override;
  const Coordinates& position() const override { return position_; }
  bool keeps_position() const override {
    return keeps_position_ && status_ && status_->interpreter == InterpreterState::Idle;
  }
  PositionTrust position_trust() const override;
  std::optional<bool> is_touching() const override;
  void drop_probe() override {}
  std::optional<streamed::ProbeEnd> probe() const override;
  void raise(std::string_view id, std::string text, SteadyTime now) override;
  const std::optional<streamed::DeviceFault>& fault() const override { return fault_; }
  void hold(SteadyTime now) override;
  bool resume(SteadyTime now) override;
  bool is_held() const override { return is_held_; }
  bool is_resuming() const override { return is_resuming_; }
  void stop(bool is_emergency, SteadyTime now) override;
  bool is_stopping() const override { return is_stopping_; }
  void restart(SteadyTime now) override;
  OperatorPanel known(OperatorPanel panel) const override { return panel; }
  void set_overrides(const OperatorPanel& panel) override;
  bool has_overrides() const override {
    return !are_overrides_due_ && done_number_ >= overrides_number_;
  }
  Result<void> home(SteadyTime now) override;
  bool is_homing() const override;
  void stop_homing(SteadyTime now) override;
  Result<void> unlock(SteadyTime now) override;
  /// By LinuxCNC's own incremental jog, in its teleop mode.
  Result<void> jog(const Jog& jog, SteadyTime now) override;
  bool is_jogging() const override { return jog_.has_value(); }
  void stop_jog(SteadyTime now) override;
  std::string jog_fault() const override { return jog_fault_; }
  void switch_off() override {}  ///< the end of a program does it
  bool is_connected() const override { return phase_ == Phase::Ready; }
  bool has_switched_off() const override;
  bool is_moving() const override;
  double feed_per_minute() const override;
  double spindle_rpm() const override;
  bool input(int pin) const override;
  std::vector<std::pair<std::string, bool>> inputs() const override;
  std::optional<interpreter::SignalValue> signal(const std::string& name, SteadyTime now) override;

 private:
  enum class Phase : std::uint8_t { Closed, Starting, Ready };
  /// Of the program that LinuxCNC reads.
  enum class Feed : std::uint8_t {
    None,
    Wanted,    ///< a FIFO is needed
    Opening,   ///< LinuxCNC was commanded to read it
    Reading,   ///< it reads
    Ending,    ///< the end was sent
    Stopping,  ///< aborted; empty lines follow until it has obeyed
  };

  enum class Stop : std::uint8_t { None, Pausing, Aborting };

  void on(const HelloReply& hello, SteadyTime now);
  void on(const StatusReply& status, SteadyTime now);
  void on(const DoneReply& done, SteadyTime now);
  void on(const MessageReply& message, SteadyTime now);
  void on(const SignalReply& signal, SteadyTime now);
  void on(const FatalReply& fatal, SteadyTime now);
  void on(const GarbageReply& garbage, SteadyTime now);

  std::uint64_t command(const std::string& members);
  void send_overrides();
  std::uint64_t write(std::string_view line);
  void execute_to(std::uint64_t line);
  void take_progress(SteadyTime now);
  void watch_hold(SteadyTime now);
  void watch_end(SteadyTime now);
  void watch_state(SteadyTime now);
  void watch_stall(SteadyTime now);
  void end_jog(std::string fault);
  void watch_jog(SteadyTime now);
  void watch_homing(SteadyTime now);
  void begin_stop(SteadyTime now);
  void abort(SteadyTime now);
  void end_program(SteadyTime now);
  void end_feed();
  streamed::TextRules rules_of(const HelloReply& hello) const;
  Result<void> check_reference() const;
  Result<void> check_wrapped() const;
  std::string with_message(std::string text) const;
  Coordinates in_mm(const Coordinates& values) const;

  SessionLimits limits_;
  Phase phase_ = Phase::Closed;
  Feed feed_ = Feed::None;
  Stop stop_ = Stop::None;
  HelperLines lines_;
  std::string commands_, text_;
  std::optional<HelloReply> hello_;
  streamed::TextRules rules_;
  std::optional<StatusReply> status_;
  Coordinates position_{};
  bool keeps_position_ = false;  ///< homed since the helper was started or the last program began
  std::string trouble_ = "LinuxCNC is not connected", reopen_reason_;
  std::optional<streamed::DeviceFault> fault_;
  std::string last_error_;  ///< LinuxCNC's, of this program

  std::uint64_t command_number_ = 0, done_number_ = 0;
  std::uint64_t shown_number_ = 0;  ///< done before the last status, which shows its effect
  std::uint64_t must_obey_ = 0;     ///< the last command that changes the machine's state
  std::uint64_t awaited_ = 0;       ///< the command whose effect the feed waits for

  std::uint64_t line_ = 0;      ///< written to this FIFO, empty lines too
  std::uint64_t executed_ = 0;  ///< of them
  std::uint64_t flushed_ = 0;   ///< a line that LinuxCNC keeps back is followed by another
  std::uint64_t preamble_ = 0;  ///< the line of its marker
  std::deque<std::uint64_t> in_flight_, markers_;
  std::string stop_mode_ = "G61";
  struct AskedSignal {
    std::string name;
    std::optional<interpreter::SignalValue> value;  ///< nothing: it has not come yet
    SteadyTime since{};
  };
  std::optional<AskedSignal> signal_;
  struct JogInHand {
    std::size_t axis = 0;
    std::uint64_t number = 0;  ///< of its command
    double to = 0;             ///< of the axis, mm or degrees
    Coordinates at{};          ///< as reported last
    SteadyTime still_since{};
    bool is_stopped = false;
  };
  std::optional<JogInHand> jog_;
  std::string jog_fault_;
  struct HomingInHand {
    std::uint64_t number = 0;  ///< of its command
    SteadyTime seen{};
  };
  std::optional<HomingInHand> homing_;

  bool is_active_ = false, is_held_ = false, is_resuming_ = false, was_paused_ = false;
  bool is_stopping_ = false, aborts_first_ = false, is_emergency_ = false;
  OperatorPanel overrides_;
  bool has_sent_overrides_ = false;  ///< of this helper: LinuxCNC has those that were sent last
  bool are_overrides_due_ = false;
  std::uint64_t overrides_number_ = 0;  ///< of the command that has sent them last
  int garbage_ = 0;
  std::size_t bytes_in_second_ = 0;
  std::chrono::milliseconds longest_{};
  SteadyTime now_{}, heard_{}, phase_began_{}, feed_began_{}, second_began_{}, sent_at_{},
      changed_at_{};
  SteadyTime hold_sent_{}, stop_limit_{};
  std::optional<SteadyTime> stopped_since_;
};

}  // namespace dripline::machine::linuxcnc
