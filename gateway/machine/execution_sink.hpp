#pragma once

#include "gateway/interpreter/core/event.hpp"
#include "gateway/machine/given_action.hpp"

namespace dripline::machine {

/// Receives what the machine has done, in the sequence of execution, each event when all motion
/// before it has finished. Called only from inside the back end's functions, on the owner's thread;
/// must not call back into it. string_views live until the function returns.
class ExecutionSink {
 public:
  virtual ~ExecutionSink() = default;
  /// Of a device that executes ahead of its reports: what it may get from now on, in order, about
  /// half a second of motion more than it may have.
  virtual void on_given(const GivenAction&) {}
  /// A move, a dwell or a probe is about to begin: the last moment to write to disk what was
  /// reported before it. False: that cannot be written. From rest nothing begins then, and it is
  /// announced again.
  virtual bool on_motion_starts(const interpreter::Origin&) { return true; }
  /// The block is done: all its moves have ended. This is the *executed* counter.
  virtual void on_block_executed(const interpreter::Origin&) {}
  virtual void on_output(const interpreter::Output&) {}
  virtual void on_open(const interpreter::Open&) {}
  virtual void on_close(const interpreter::Close&) {}
  virtual void on_message(const interpreter::Message&) {}
  virtual void on_warning(const interpreter::Warning&) {}
  virtual void on_spindle(const interpreter::Spindle&) {}
  virtual void on_coolant(const interpreter::Coolant&) {}
  virtual void on_tool(const interpreter::ToolChange&) {}
  virtual void on_miscellaneous(const interpreter::Miscellaneous&) {}
  virtual void on_pin(const interpreter::PinChange&) {}
  /// The probe move of `begin_probe` is over; `result` is present. Answer the interpreter with it
  /// after the back end's function has returned.
  virtual void on_probed(const interpreter::Probe&) {}
  /// A stop was reached. An optional stop with its switch off is not reported.
  virtual void on_stop(const interpreter::Stop&) {}
  /// The program's alarm, or the machine's own (MCH...): nothing that is queued after it is
  /// executed.
  virtual void on_alarm(const interpreter::Alarm&) {}
  virtual void on_end(const interpreter::End&) {}
  /// `abort` has brought the axes to rest; what was queued is discarded.
  virtual void on_aborted() {}
};

}  // namespace dripline::machine
