#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A machine and what it does now, as api_types.hpp has all answers of the server.
namespace dripline::client {

/// The modal state that a control's status window shows; millimeters.
struct ActiveModes {
  std::string motion, compensation, units;
  bool incremental = false;
  std::string feed_unit;
  double feed = 0;  ///< programmed, in its unit
  bool feed_limited = false;
  std::optional<std::int64_t> tool, next_tool, tool_offset;
  double tool_length_x = 0, tool_length_z = 0, tool_radius = 0;
  std::string work_system, cycle;
  double dwell_seconds = 0;
  bool surface_speed = false;
  double spindle_speed = 0;  ///< programmed: 1/min, or mm per minute
  std::optional<double> spindle_load;
  bool flood = false, mist = false;
  std::string tool_axis;  ///< its letter; empty: programs do not choose it
  std::string spindle;    ///< "off", "clockwise", ...; empty: unknown
};

/// How program coordinates lie on the machine; by axis letter, millimeters and degrees.
struct ProgramFrame {
  std::map<std::string, double> position, target;  ///< program coordinates
  std::map<std::string, double> datum, shift;
  double rotation = 0, basic_rotation = 0;
  std::map<std::string, double> scale;
  std::vector<std::string> mirrored;
  std::optional<std::map<std::string, double>> pole;
};

/// The values of a control's position display, along the machine's axes.
struct Coordinates {
  std::map<std::string, double> target;  ///< the end of the current move
  std::map<std::string, double> distance_to_go;
  /// The following error; absent: not measured.
  std::optional<std::map<std::string, double>> following_error = {};
  /// Absent without a run, or when its control reports none.
  std::optional<ProgramFrame> program = {};
};

/// Each "on" or "off"; empty: the control or the machine has none.
struct PanelSwitches {
  std::string optional_stop, block_skip;
  std::string skip_levels;  ///< those from 2 on that are skipped: "2,9"
  std::string dry_run, machine_lock, handwheel, test_run;
};

/// What the gateway allows of jogs.
struct JogStatus {
  double step = 0, feed = 0;  ///< the largest, mm or degrees; per minute. No step: none is allowed
  bool moving = false;
  std::string refusal;  ///< why none can begin now; empty: one can
};

/// What the control's screen shows; texts are empty where it shows none.
struct Screen {
  std::string units = "mm";   ///< or inch
  std::string position = {};  ///< which one its operator has chosen; empty: there is no choice
  std::string previous_block = {}, block = {}, next_block = {}, further_block = {};
};

struct MachineStatus {
  std::string time, execution, mode, run, program;
  std::uint64_t sent = 0, accepted = 0, executed = 0, total_bytes = 0, offset = 0;
  std::optional<std::uint64_t> line;
  std::optional<std::int64_t> sequence;
  std::map<std::string, double> position;  ///< by axis letter
  double feed_mm_per_min = 0, spindle_rpm = 0;
  double feed_override = 1, rapid_override = 1, spindle_override = 1;  ///< 1 = 100 %
  double buffered_seconds = 0;
  bool single_block = false;
  std::string message;
  std::uint64_t outbox = 0;
  std::optional<ActiveModes> modes;
  std::optional<Coordinates> coordinates;
  bool emergency_stop = false;  ///< pressed
  std::string remote_enable, waits_for;
  std::optional<Screen> screen =
      {};  ///< absent: an older gateway or server, or a control on a line
  std::optional<PanelSwitches> switches = {};  ///< absent: an older gateway or server
  std::optional<JogStatus> jog = {};           ///< absent: likewise, or the machine is not jogged
};

/// What a control's own position display shows. Values of the API are millimeters and radii.
struct Display {
  std::string units = "mm";  ///< or inch
  std::string x = "radius";  ///< or diameter
  /// Which of the modes that not every control has it has; absent: an older server.
  std::optional<std::vector<std::string>> fields = {};
};

/// How a run can begin on a machine's control.
struct Starts {
  std::vector<std::string> at;  ///< what a start can name: block, line, byte, tool, count
  bool head = false, memory = false, pass = false;
  std::uint64_t mdi = 0;  ///< how many blocks are keyed in at once; 0: none, or an older server
};

/// What the control's screen takes over from where the axes are.
struct Positions {
  std::vector<std::string> offsets;   ///< work offsets; empty: one datum without a name, or none
  std::string datum_axes, tool_axes;  ///< letters; empty: no datum, no lengths
  bool x_diameter = false, zero_only = false, playback = false;
};

struct PositionSet {
  std::string machine, change, text;
  std::string what;  ///< as it was asked: "tool 3 Z 0 mm G54"
  struct Cell {
    std::string name;
    std::optional<double> before;  ///< absent: vacant
    double value = 0;
    std::string unit;  ///< mm, in, deg
  };
  std::vector<Cell> cells = {};  ///< empty: an older gateway or server gives the text alone
  /// Of the tool in force along the axis, and of the work offset that a length is of; in the unit
  /// of the first cell.
  std::optional<double> length = {}, zero = {};
};
/// Where an axis is after a step.
struct JogDone {
  std::string machine, text, axis;
  double position = 0, moved = 0;  ///< machine coordinates; X of a lathe is a diameter
  std::string unit;                ///< mm, in, deg
  bool reached = false;            ///< false: it was stopped before its end
};
struct PlaybackBlock {
  std::string machine, block;
};

/// Who holds a machine or its job queue, and why.
struct Hold {
  std::string who, reason;  ///< reason empty: none was given
  std::string run;          ///< of a machine; empty: of none
  std::string since;
};

struct Machine {
  std::string name, control, description, gateway_version;
  bool connected = false;
  std::optional<std::string> unconfirmed_gateway = {};  ///< its version; absent: none
  bool stale = false;  ///< connected, but its status does not arrive: what is here may be wrong
  /// How far the gateway's clock is ahead of the server's; negative: it is late.
  std::optional<double> clock_ahead_seconds;
  /// What is wrong between server and gateway.
  std::vector<std::string> notices;
  std::string first_seen, last_seen;
  std::optional<Hold> held = {};            ///< absent: nothing is known to hold it
  std::optional<Hold> queue_hold = {};      ///< absent: its queue is not held
  std::optional<Display> display = {};      ///< absent: the control is not known
  std::optional<Starts> starts = {};        ///< absent: an older server
  std::optional<Positions> positions = {};  ///< likewise
  std::optional<MachineStatus> status;
};

}  // namespace dripline::client
