#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "gateway/machine/motion_backend.hpp"
#include "gateway/machine/operator_panel.hpp"
#include "gateway/machine/streamed/text_rules.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::machine::streamed {

/// Why a program cannot continue; ids as in the device's README.
struct DeviceFault {
  std::string_view id;  ///< static storage
  std::string text;
};

/// How a probe move has ended.
struct ProbeEnd {
  bool tripped = false;
  Coordinates at{};  ///< where it tripped
};

/// A controller that executes lines of text in their order: the conversation with it, as a state
/// machine without a thread. StreamedMachine owns the program; this owns the link.
///
/// Nothing that moves is ever sent by itself: motion comes by `send`, and leaves a hold only by
/// `resume`. After a fault the device is stopped, which drops what it had, and then nothing is sent
/// until `restart`. All functions are called under StreamedMachine's mutex.
class Device {
 public:
  virtual ~Device() = default;

  // -- the program --------------------------------------------------------------------------------
  /// Of the device that is connected now.
  virtual const TextRules& rules() const = 0;
  /// A program can begin: identified, referenced, at rest, without a fault. Errors: Busy, Conflict,
  /// Unsupported, with the reason.
  virtual Result<void> check_ready() const = 0;
  /// A program begins or is over: only meanwhile a misbehavior of the device is a fault.
  virtual void set_active(bool is_active, SteadyTime now) = 0;
  /// Brings the modes about that all lines rely on, once for a program. False: not yet.
  virtual bool prepare(SteadyTime now) = 0;
  /// A line of so many characters can be sent now.
  virtual bool may_send(std::size_t bytes) const = 0;
  /// Sends a line; returns its serial number. `longest`: how long the device may be at rest with
  /// it.
  virtual std::uint64_t send(const std::string& line, bool moves,
                             std::chrono::milliseconds longest) = 0;
  /// Nothing follows before what was sent is executed. Repeated calls do nothing.
  virtual void await_execution() = 0;
  /// Of the last line that is executed, as the device's own reports show.
  virtual std::uint64_t executed() const = 0;
  /// Everything that was sent is executed.
  virtual bool is_empty() const = 0;
  /// A report made since shows the axes at rest: `position` can be compared.
  virtual bool is_at_rest() const = 0;
  /// At the program's end, with everything executed: takes leave of it, so that the next one can
  /// begin at once. False: not yet.
  virtual bool finish(SteadyTime /*now*/) { return true; }
  /// In machine coordinates.
  virtual const Coordinates& position() const = 0;
  /// `position` is that of since the last program began, or the link was opened.
  virtual bool keeps_position() const = 0;
  virtual PositionTrust position_trust() const = 0;
  /// Whether the probe is in contact now; nothing: the device does not report it.
  virtual std::optional<bool> is_touching() const { return std::nullopt; }
  virtual void drop_probe() = 0;
  virtual std::optional<ProbeEnd> probe() const = 0;
  virtual void raise(std::string_view id, std::string text, SteadyTime now) = 0;
  virtual const std::optional<DeviceFault>& fault() const = 0;

  // -- the operator -------------------------------------------------------------------------------
  virtual void hold(SteadyTime now) = 0;
  /// False: the device cannot continue.
  virtual bool resume(SteadyTime now) = 0;
  virtual bool is_held() const = 0;
  /// It was commanded to leave the hold, and no report has shown it yet.
  virtual bool is_resuming() const = 0;
  /// A safety door was opened since the hold began: it is left by the operator alone.
  virtual bool needs_operator() const { return false; }
  /// Decelerates and drops what was sent. Ends when `is_stopping` does.
  virtual void stop(bool is_emergency, SteadyTime now) = 0;
  virtual bool is_stopping() const = 0;
  /// The emergency stop was released: ends a fault.
  virtual void restart(SteadyTime now) = 0;
  /// The nearest overrides that the device has.
  virtual OperatorPanel known(OperatorPanel panel) const = 0;
  /// Of feed, rapid and spindle, as factors.
  virtual void set_overrides(const OperatorPanel& panel) = 0;
  /// Those that were set last are in force: what is sent now is executed with them.
  virtual bool has_overrides() const = 0;
  virtual Result<void> home(SteadyTime now) = 0;
  /// Until the axes are at their reference points, or were stopped.
  virtual bool is_homing() const = 0;
  /// The position is lost.
  virtual void stop_homing(SteadyTime now) = 0;
  virtual Result<void> unlock(SteadyTime now) = 0;
  /// One axis by a distance, with no program active, at rest and ready. Errors: Unsupported, Busy.
  virtual Result<void> jog(const Jog&, SteadyTime /*now*/) {
    return fail(Errc::Unsupported, "this machine moves by programs alone: it is not jogged");
  }
  /// Until a report made after the jog shows the axes at rest, or it is lost.
  virtual bool is_jogging() const { return false; }
  virtual void stop_jog(SteadyTime /*now*/) {}
  /// As MotionBackend's.
  virtual std::string jog_fault() const { return {}; }
  /// Why it cannot leave a hold, for the operator; empty: it can.
  virtual std::string hold_reason() const { return {}; }

  /// Spindle and coolant off, with everything executed and the program at its end by an alarm of
  /// its own.
  virtual void switch_off() = 0;
  /// It hears what it is sent.
  virtual bool is_connected() const = 0;
  /// It has reported what shows that a stop, or `switch_off`, has switched spindle and coolant off,
  /// and was sent nothing since.
  virtual bool has_switched_off() const = 0;

  // -- what it does -------------------------------------------------------------------------------
  virtual bool is_moving() const = 0;
  virtual double feed_per_minute() const = 0;
  virtual double spindle_rpm() const = 0;  ///< without a sign
  virtual bool input(int pin) const = 0;
  /// As MotionBackend's.
  virtual std::vector<std::pair<std::string, bool>> inputs() const { return {}; }
  virtual std::optional<interpreter::SignalValue> signal(const std::string& /*name*/,
                                                         SteadyTime /*now*/) {
    return no_signals();
  }
};

}  // namespace dripline::machine::streamed
