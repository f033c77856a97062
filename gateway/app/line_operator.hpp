#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gateway/app/run/run_session.hpp"
#include "gateway/app/state_mark.hpp"
#include "gateway/feed/control_line.hpp"
#include "gateway/feed/line_feed.hpp"
#include "gateway/line/loss_log.hpp"

namespace dripline::gateway {

/// The operator of a control at the end of a serial line: asks the host for programs or waits for
/// them, begins a run with the first text, and sends back what the program prints. One thread.
class LineOperator {
 public:
  struct Parts {
    feed::ControlLine& line;
    std::string control;
    std::string request;  ///< see LineOptions::request
    const machine::MotionBackend& machine;
    CurrentRun& run;
    const Clock& clock;
    std::function<Result<void>(const report::ActiveRun&, std::unique_ptr<feed::ProgramFeed>)>
        begin_run;
    /// The text of a run has begun, and has not gone through: what comes next may be its rest.
    StateMark doubt = StateMark({});
  };
  /// All references must outlive it.
  explicit LineOperator(Parts parts);

  void poll(SteadyTime now);
  /// When to be called again at the latest; none: when the line has something.
  std::optional<SteadyTime> next_poll(SteadyTime now) const;
  /// The run's session is gone.
  void on_run_over();
  /// A run was cut off: the host may be in the middle of its text, also in the next life.
  void doubt_text();
  /// The operator's reset, at the panel: the next text begins a run, however it begins. False: no
  /// text waits for that.
  bool reset();
  void print(const interpreter::Output& output);

  /// What is wrong with the line; empty: nothing.
  const std::string& fault() const { return fault_; }
  const std::string& address() const { return parts_.line.address(); }

 private:
  /// What happens to text that arrives.
  enum class State : std::uint8_t {
    Closed,     ///< the host was not asked yet
    Listening,  ///< it begins a run
    Feeding,    ///< it belongs to the run
    Complete,   ///< none is expected: the run's text is complete
    BrokenOff,  ///< the run's text ended in a fault: the rest of it is dropped
    Draining,   ///< as that, until the line is quiet: the run has ended
    Locked,     ///< a tape is where its run was cut off: the reader waits for the operator's reset
  };
  void take(feed::LineItem& item);
  bool belongs_to_next_run(const feed::LineItem& item) const;
  void take_text(std::string_view text);
  void begin_text();
  void drop_head();
  void end_text();
  void fail_text(const std::string& reason);
  Result<void> begin_run();
  void keep_doubt(bool is_in_doubt) const;
  void listen(bool may_ask);
  void release();
  void set_fault(std::string_view reason);
  void on_channel(const std::string& lost);
  void on_steady();
  void log_line(const std::optional<line::LossLog::Message>& message) const;

  Parts parts_;
  line::LossLog losses_;
  State state_ = State::Closed;
  feed::LineFeed* feed_ = nullptr;  ///< of the session
  std::uint64_t released_ = 0;      ///< bytes of its text
  std::string program_, fault_;
  bool is_in_doubt_ = false;  ///< what comes next may be the rest of a text that was cut off
  std::string head_;          ///< of such a text: what came before its first line is complete
  std::set<std::string> logged_faults_;  ///< since text came, or the line was steady last
  std::string request_;                  ///< still to be asked for; "next": always
  std::optional<SteadyTime> listen_at_;
  SteadyTime drained_from_{};         ///< quiet counts from here on
  std::vector<feed::LineItem> held_;  ///< of the next run: the emergency stop is pressed
};

}  // namespace dripline::gateway
