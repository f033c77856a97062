#pragma once

#include <array>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/fanuc/state.hpp"
#include "gateway/interpreter/stages/tilting/kinematics.hpp"

namespace dripline::interpreter::fanuc {

enum class Model : std::uint8_t { M0, M6, M11, M16, I0, I16, I18, I21, I30 };
enum class RepeatAddress : std::uint8_t { K, L, Both };
enum class CallForm : std::uint8_t { EightDigits, L, Both };
enum class OffsetMemory : std::uint8_t { A, B, C };

/// What a machine's builder and operator have set: the `[control]` options and the panel's
/// switches. Lengths in millimeters.
struct ControlOptions {
  bool is_lathe = false;
  CodeSystem code_system = CodeSystem::A;  ///< of a lathe
  bool x_is_diameter = false;
  bool has_c_axis = false;       ///< of a lathe
  bool has_y_axis = false;       ///< of a lathe
  int turret_digits = 2;         ///< of the offset number in T
  std::size_t max_pockets = 10;  ///< of G71 and G72; 0: any number
  double feed_unit_turn = 0;     ///< of F without a point, per revolution; 0: an alarm
  double thread_chamfer = 0;     ///< of G92, in leads
  Model model = Model::M16;
  bool has_pages = true;                 ///< G54.1
  bool has_later_functions = false;      ///< MOD, POW
  bool has_long_variables = false;       ///< #100001 and up, #14001, #4201; PRM, names of variables
  int program_digits = 4;                ///< of O numbers
  bool has_program_names = false;        ///< <NAME> instead of an O number
  bool has_rigid_tap_codes = false;      ///< G84.2 and G84.3
  bool compensates_in_contour = true;    ///< G40 to G42 from P to Q of G70
  std::uint32_t last_sequence = 99'999;  ///< of N
  bool calculator_point = false;
  bool has_tool_changer = true;  ///< false: M06 stops for the operator's hands
  int decimals_mm = 3;           ///< of the least increment; inches have one more
  Units start_units = Units::Millimeter;
  std::vector<std::uint8_t> start_g;
  RepeatAddress repeat_address = RepeatAddress::Both;
  CallForm call_form = CallForm::Both;
  OffsetMemory offset_memory = OffsetMemory::A;
  bool start_up_b = false;
  std::array<AxisValues, 4> reference{};
  double peck_return = 0.1;      ///< d of G73
  double peck_clearance = 1;     ///< d of G83
  double peck_tap_return = 0.1;  ///< d of a peck in rigid tapping
  bool peck_tap_leaves = false;  ///< the tap retracts to R between pecks, else back by d
  double shift_first = 1;        ///< direction of G76 and G87 along the plane's axes
  double shift_second = 0;
  AxisValues single_direction{};
  double arc_error = 0.01;  ///< 0: not checked
  bool arc_needs_center = false;
  bool helix_feed_is_path = false;  ///< F of a helix: along it, not along its circle
  bool short_radius_is_semicircle = false;
  double scale_default = 1;
  double rotate_default = 0;
  bool rotate_incremental = false;
  bool leading_zero_print = true;
  bool print_expands = false;
  bool atan_is_signed = false;
  bool reset_clears_locals = true;
  bool reset_clears_commons = true;
  double measuring_rapid_end = 0;  ///< G37: feed begins so far before the position; 0: no G37
  double measuring_tolerance = 0;  ///< G37: the signal comes so close to the position
  double measuring_feed = 0;       ///< G37, millimeters a minute
  bool has_limits = false;
  std::array<double, 3> limit_low{};
  std::array<double, 3> limit_high{};
  StrokeZone zone;  ///< limit 2 before any G22
  tilting::Kinematics kinematics;
  double dry_run_feed = 0;        ///< `dry_run_feed`, mm per minute; a panel's, not a program's
  std::uint16_t skip_levels = 0;  ///< bit n: switch n is on
  std::vector<std::int64_t> g_macros;
  std::vector<std::int64_t> m_macros;
  bool t_macro = false;
  bool semicolon_eob = true;
  bool comment_over_eob = false;
  double feed_unit_inch = 0.01;
  bool diameter_offset = false;
  std::vector<std::int64_t> before_m;
  bool is_dnc = false;
  bool is_mdi = false;          ///< Setup::is_mdi
  std::string external_folder;  ///< of M198: what precedes the program in its name
  std::size_t max_call_depth = 4;
  std::size_t max_nesting = 8;
  std::uint64_t max_loops = 1'000'000;
  std::uint64_t max_blocks = 10'000'000;
  int last_common = 149;
  int last_kept = 531;
  bool has_extra_commons = false;  ///< #98000 to #98499
  char length_axis_type = 'A';
  bool optional_stop = false;
  bool answers_pins = false;
  std::vector<std::int64_t> pins_at_one;

  /// Whether axes have limits that the program cannot change.
  bool checks_stroke() const { return has_limits || kinematics.has_limits; }
};

/// Reads the options. Errors: Syntax, Unsupported (an option or switch this control does not
/// have).
Result<ControlOptions> read_options(const Setup& setup, bool is_lathe = false);

/// The control's memory at the start of a run. Errors: Unsupported, naming the record of the setup
/// that this control does not have.
Result<void> load_memory(const Setup& setup, const ControlOptions& options, ModalState& state,
                         Memory& memory);

/// The G codes that power on and reset put in force; units, work system and cycle data aside.
void apply_start_codes(const ControlOptions& options, ModalState& state);

/// The rows of its options, for people.
std::vector<ListedOption> list_options();
std::vector<ListedOption> list_lathe_options();

}  // namespace dripline::interpreter::fanuc
