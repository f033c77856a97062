#pragma once

#include <string>
#include <vector>

#include "gateway/app/memory/control_memory.hpp"
#include "gateway/app/memory/position_change.hpp"
#include "gateway/app/run/run_session.hpp"
#include "gateway/interpreter/position_rules.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::gateway {

/// Takes over where the axes of a machine at rest are, as the operator does at the control's
/// screen: into the control's memory (datum, length of a tool), or into the words of a block.
/// Nothing moves, and its owner asks for it only while no run is active. One thread.
class PositionSetter {
 public:
  struct Parts {
    const interpreter::Dialect& dialect;
    const interpreter::Setup& setup;  ///< the gateway's own
    const machine::MotionBackend& machine;
    ControlMemory& memory;
    const CurrentRun& run;
  };
  /// All references must outlive it.
  explicit PositionSetter(Parts parts) : parts_(parts) {}

  /// Changes the memory; its owner stages it. `argument`: interpreter::PositionSetting; `who`: the
  /// operator; `setup`: the server's, as with a start, TOML. Errors: Unsupported, NotFound,
  /// LimitExceeded, Busy, Conflict, Syntax; the memory has to be restored then.
  Result<PositionChange> set(const std::string& argument, const std::string& who,
                             const std::string& setup);
  /// The words of a block with the position of these axes ("XY") in program coordinates. Errors:
  /// likewise; the memory is as it was.
  Result<std::string> playback(const std::string& axes, const std::string& setup) const;
  /// Whether an axis may go by a distance (mm or degrees, X of a lathe as a radius) from where the
  /// axes rest: it is there, their position is certain, and the control's own limits allow it.
  /// `setup`: likewise. Errors: Unsupported, Busy, Conflict, LimitExceeded; those of the setup.
  Result<void> check_jog(interpreter::Axis axis, double distance, const std::string& setup) const;
  /// In which a start would show the position; nothing: the control reports none, or would not
  /// start. `setup`: likewise.
  std::optional<interpreter::CoordinateFrame> frame_at_start(const std::string& setup) const;
  /// The gateway's own with the server's, and where the axes are. Errors: those of the text.
  Result<interpreter::Setup> setup_of(const std::string& setup) const;
  /// A copy, as the start of a program would find it. Errors: those of the setup and of the memory.
  Result<ControlMemory> memory_at_start(const std::string& setup) const;

 private:
  struct Control;
  /// With what the memory keeps, which is added to the setup.
  Result<Control> control_at_start(interpreter::Setup& setup) const;
  Result<Control> make_control(const interpreter::Setup& setup) const;
  /// One that keeps datums and tools.
  Result<Control> control_with(const interpreter::Setup& setup) const;
  Result<std::vector<interpreter::VariableRecord>> begin_memory(
      ControlMemory& memory, const interpreter::Setup& setup) const;
  Result<void> check_rest() const;
  enum class Sets { Length, Datum };
  Result<void> check_tool(interpreter::Axis axis, Sets what) const;
  Result<void> check_axis(interpreter::Axis axis, const interpreter::Setup& setup) const;
  /// `kept`: so many variables at the end of the setup are those of the memory.
  Result<void> check_frames(const Control& control, const interpreter::Setup& setup,
                            std::size_t kept) const;
  bool moves_with_lengths() const;
  interpreter::RestingPlace place(const interpreter::Setup& setup) const;

  Parts parts_;
};

}  // namespace dripline::gateway
