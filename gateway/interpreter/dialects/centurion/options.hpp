#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialect.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/machine_parameters.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"
#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/dialects/centurion/start/start_search.hpp"
#include "gateway/interpreter/stages/blending/policy.hpp"

namespace dripline::interpreter::centurion {

/// A drilling or grooving cycle while the spindle is stopped.
enum class SpindleCheck : std::uint8_t { Ignore, Warn, Alarm };

/// What a machine's builder and operator have set: the `[control]` options that touch what this
/// version does (`dnc setup options centurion`), and the panel's switches.
struct ControlOptions {
  bool block_skip = false;
  bool optional_stop = false;
  bool refuses_loops_and_calls = false;  ///< `dnc_refusals`
  bool refuses_goto = false;             ///< `dnc_refusals` with `resolve_dnc` off
  std::array<double, 3> spindle_ranges{9999, 9999, 9999};  ///< most revolutions: low, medium, high
  double pulse_ms = 150;                                   ///< of PULSE0 and PULSE1
  bool asks_for_inputs = false;     ///< `ask_inputs`: waits for inputs ask the owner
  std::optional<StartAt> start_at;  ///< `start_at`: not the first block
  /// `start_pass`: which time the program comes to that block, where it may come more than once.
  std::optional<std::uint64_t> start_pass;
  /// `start_memory` = "begin" (what is given is as it was when the program began) or "now": the
  /// part before the start may change what it has read before.
  bool may_count_again = false;
  bool single_block = false;           ///< the panel's switch; cycles stop at their clearance
  bool is_dry_run = false;             ///< the panel's switch
  double dry_run_feed_mm = 0;          ///< `dry_run_feed`, per minute
  double power_on_feed_mm = 0;         ///< `power_on_feed`, per minute or revolution
  bool dry_run_turns_spindle = false;  ///< `dry_run_spindle`
  bool is_dnc_fast = false;            ///< `dnc_mode = "fast"`: what that mode refuses
  bool is_mdi = false;                 ///< `mode = "mdi"`: one block, no M98
  bool is_verify = false;              ///< `mode = "verify"`
  bool draws_part_path = false;        ///< part_path.hpp; no option of a setup
  bool interlocks_coolant = false;     ///< `coolant_interlock`: coolant runs while the spindle runs
  bool has_custom_codes = false;
  std::array<int, 10> custom_g{};          ///< bound to O9010-O9019; 0 none
  std::array<int, 10> custom_m{};          ///< bound to O9020-O9029
  std::uint16_t tool_change_program = 0;   ///< `m6_macro`: in the place of M6; 0 none
  std::optional<int> tool_change_pin;      ///< `m6_pin`: the output that M6 pulses
  bool tool_change_stops_spindle = false;  ///< `m6_spindle`: a running one is stopped
  /// `tool_changer`: M6 is done by a changer, as where the machine has pockets of one; else by
  /// hand, and CYCLE START resumes.
  bool has_tool_changer = false;
  Pockets pockets{};                                ///< of a tool changer
  std::vector<int> post_m;                          ///< M codes that come last
  SpindleCheck spindle_check = SpindleCheck::Warn;  ///< `cycle_spindle`
  double tap_ramp_seconds = 0;                      ///< `tap_ramp`: from full speed to standstill
  /// `groove_relief`: G74 and G75 back off in the direction of their steps, not against it.
  bool groove_relief_goes_on = false;
  blending::Chamfer chamfer = blending::Chamfer::Leg;  ///< `chamfer`: what the size of ,C is
  bool solver_x_is_radius = false;           ///< `solver_x`: of the points of TANL, TANA and CGEN
  std::array<int, 2> trailing_digits{4, 3};  ///< of #n without format: inch, metric
  std::array<int, 2> leading_digits{0, 0};
  std::string report_file;
  std::vector<std::int64_t> pins_at_one;
  bool answers_pins = false;  ///< `pins` was given: no operator need be asked
};

/// Reads the options. Errors: Syntax, Unsupported (an option this control does not have, or has
/// but this version does not honor).
Result<ControlOptions> read_options(const Setup& setup);

/// The rows of its options, for people.
std::vector<ListedOption> list_options();

}  // namespace dripline::interpreter::centurion
