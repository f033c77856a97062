#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/option_rows.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/control_version.hpp"
#include "gateway/interpreter/stages/tilting/kinematics.hpp"

namespace dripline::interpreter::tnc155 {

/// What the first positioning block of a run must be. After GOTO it must be complete.
enum class ProgramStart : std::uint8_t {
  Absolute,  ///< without incremental words
  Complete,  ///< and with two coordinates at least
  Any,
};

/// What the machine builder, the software version or a choice of ours decides. Lengths are
/// millimeters, feeds millimeters per minute.
struct ControlOptions {
  bool is_mdi = false;     ///< Setup::is_mdi
  ControlVersion version;  ///< which control it is: what it has not is refused
  /// A row of the preset table: the setup's offset "preset1".
  struct Preset {
    int number = 0;
    Position datum;
  };
  std::vector<Preset> presets;
  std::optional<Axis> kept_tool_axis;  ///< of the run before, until TOOL CALL names one
  bool compares_rounded = false;       ///< FN 9 to FN 12: within rounding, else all binary digits
  bool block_skip = false;             ///< Switches::block_skip, of a later control
  bool is_itnc = false;                ///< TNC 426/430, iTNC 530: the rules of itnc/
  tilting::Kinematics kinematics;      ///< of a five-axis machine: PLANE, M128

  // touch probe
  double probe_clearance = 2;
  double probe_travel = 100;
  double probe_feed = 200;
  double basic_rotation = 0;  ///< degrees, as the probe measured it

  double pocket_overlap = 1;  ///< factor k: stepover of pockets as a share of the tool radius
  double plunge_angle = 0;    ///< ANGLE of a later control's tools, degrees; 0: straight down only
  bool m89_modal = true;      ///< M89 is the modal cycle call; else a free M function
  bool m06_stop = false;      ///< M06 stops the program
  bool central_tool_file = false;
  bool random_changer = false;  ///< a tool goes back into the pocket of the one that comes
  int magazine_pockets = 0;     ///< pockets are 1 to this
  bool iso_continuation = true;
  bool blockwise_restrictions = false;  ///< no calls, repeats and jumps, no tool but the last one
  bool checks_calls = true;             ///< programs that are called must be there at the start
  /// What G functions leave in force belongs to the run; off: to each program, where nothing is
  /// preset, and the caller finds its own again.
  bool modes_go_over_calls = false;
  bool strict_numbers = false;        ///< blocks of plain language are numbered without gaps
  char decimal_sign = ',';            ///< of texts that are written
  std::int32_t block_increment = 10;  ///< of ISO block numbers that are written
  /// The control keeps its programs: one that does not fit its memory does not run. Otherwise they
  /// are drip-fed, and that is only worth a warning.
  bool memory_limits = false;
  std::size_t memory_blocks = 3'100;    ///< of all programs; a TNC 151 may have 1200
  bool cancels_transformations = true;  ///< M02, M30 and END PGM do (MP 173)
  bool scales_three_axes = true;        ///< cycle 11: all main axes, else those of the plane

  bool spindle_coded = false;  ///< only the speeds of `spindle_table`, rounded up
  std::vector<double> spindle_table;
  double spindle_minimum = 0;
  double spindle_maximum = 30'000;

  /// A feed with linear and rotary axes together is that of the path of all of them (software 03
  /// and later); off: that of the rotary axis.
  bool contour_feed = true;
  double circle_tolerance = 0.016;  ///< radii of an arc's start and end may differ by so much
  Axis fourth_axis = Axis::C;       ///< axis IV
  /// MOD function LIMIT: machine coordinates that a move may reach, of the axes that are marked.
  Position limit_low, limit_high;
  Position m92_position;  ///< what coordinates of M92 refer to
  ProgramStart program_start = ProgramStart::Absolute;
  int start_block =
      -1;  ///< GOTO before the start: number of the first block; -1: none (`start_at` too)
  std::int64_t start_pass = 0;  ///< which time the program comes to it; 0: it must come once
};

/// Errors: Syntax, Unsupported; naming the option.
Result<ControlOptions> read_options(const Setup& setup);

/// `decimal_sign` alone, of options that may be another control's besides. Errors: Syntax.
Result<char> decimal_sign_of(const Options& options);

/// Limits and speeds that exclude each other. Errors: Syntax.
Result<void> check_limits(const ControlOptions& read);

/// The rows of its options, for people.
std::vector<ListedOption> list_options();

/// `start_at`: a block as a start names it, "N400" or "400", up to `highest`; empty changes
/// nothing. Errors: Syntax.
Result<void> read_start_block(const Options& options, int highest, ControlOptions& control);

/// `start_pass`, after the start. Errors: Syntax (a pass and no start).
Result<void> read_start_pass(const Options& options, const OptionKey& key, ControlOptions& control);
inline constexpr OptionKey kStartPass =
    option("start_pass", kWhole,
           "which time the program comes to that block, with the repeats and return addresses that "
           "it has there; 0: it must come there once",
           "0", {0, 1'000'000});

/// The options of the later controls, which are fewer; itnc/itnc_options.cpp. Errors as above.
Result<ControlOptions> read_itnc_options(const Setup& setup);
std::vector<ListedOption> list_itnc_options();

}  // namespace dripline::interpreter::tnc155
