#include "gateway/interpreter/dialects/centurion/codes/modes.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// Everything the control keeps as a length of the machine follows the units; the program's own
/// parameters do not (manual: G20 and G21).
void change_units(Run& run, Units units) {
  ModalState& state = run.state;
  if (state.units == units) return;
  const double factor =
      units == Units::Millimeter ? Length::kMillimetersPerInch : 1 / Length::kMillimetersPerInch;
  Transformation& how = state.transformation;
  for (Point* point :
       {&state.position, &state.previous, &state.length_taken, &state.previous_machine,
        &state.origin, &state.floating_zero, &state.local_zero, &state.last_arc_center,
        &state.reference_via.at, &how.mirror, &how.scale_center, &how.rotation_center}) {
    point->x *= factor;
    point->z *= factor;
  }
  for (double* value :
       {&state.feed[0], &state.feed[1], &state.last_arc_radius, &state.retained.radius,
        &state.retained.center_x, &state.retained.center_z}) {
    *value *= factor;
  }
  constexpr double kFeetPerMeter = 1000 / (12 * Length::kMillimetersPerInch);
  state.spindle.surface *= units == Units::Millimeter ? 1 / kFeetPerMeter : kFeetPerMeter;
  run.parameters.convert_tables(factor);
  refresh_tool(run);
  state.units = units;
  run.update_origin();
  if (state.has_header) run.events().on_units({run.origin, units});
}

/// The number of a byte parameter in P1, checked; none: the run has failed.
std::optional<int> byte_number(Run& run) {
  const double number = run.parameters[1];
  if (!(number >= 0 && number < kByteCount) || number != std::trunc(number)) {
    run.fail(ErrorCode::ParameterOutOfRange, 0, fmt::format("P1 = {}", number));
    return std::nullopt;
  }
  run.start.note_read(1);
  return static_cast<int>(number);
}

}  // namespace

bool set_motion(Run& run, const GRow& row) {
  run.state.modes.motion = static_cast<MotionMode>(row.code);
  return true;
}

bool set_exact_stop(Run& run, const GRow&) {
  run.block.parts.rests = true;
  return true;
}

bool set_data_mode(Run& run, const GRow& row) {
  run.state.modes.takes_data = row.code == 10;
  if (row.code == 10) return true;
  for (const DataChange& change : run.state.data_changes) {
    note_table_set(run, change.number);
    run.parameters[change.number] = change.value;
  }
  run.state.data_changes.clear();
  run.update_origin();
  refresh_tool(run);
  run.update_stages();
  return true;
}

bool set_units(Run& run, const GRow& row) {
  change_units(run, row.code == 20 ? Units::Inch : Units::Millimeter);
  return true;
}

bool set_safe_zone(Run& run, const GRow& row) {
  run.state.modes.checks_zone = row.code == 22;
  run.update_stages();
  return true;
}

bool set_return_level(Run& run, const GRow& row) {
  run.state.modes.returns_to_clearance = row.code == 39;
  return true;
}

bool set_compensation(Run& run, const GRow& row) {
  run.state.modes.compensation = static_cast<std::uint8_t>(row.code - 40);
  run.state.nose_is_stale = true;
  return true;
}

bool cancel_tool_length(Run& run, const GRow&) {
  run.state.tool.has_no_length = true;
  return true;
}

bool set_work_system(Run& run, const GRow& row) {
  run.state.modes.work_system = static_cast<std::uint8_t>(row.code - 54);
  run.update_origin();
  return true;
}

bool set_path_mode(Run& run, const GRow& row) {
  run.state.modes.path = row.code == 61   ? PathMode::ExactStop
                         : row.code == 63 ? PathMode::Tapping
                                          : PathMode::Cutting;
  if (run.state.has_header) run.events().on_override_inhibit(override_inhibit(run));
  return true;
}

bool set_distance_mode(Run& run, const GRow& row) {
  run.state.modes.is_incremental = row.code == 91;
  return true;
}

bool set_spindle_unit(Run& run, const GRow& row) {
  run.state.modes.is_surface_speed = row.code == 96;
  return true;
}

bool set_feed_unit(Run& run, const GRow& row) {
  run.state.modes.is_feed_per_revolution = row.code == 99;
  return true;
}

bool read_byte_parameter(Run& run, const GRow&) {
  const auto number = byte_number(run);
  if (!number) return false;
  run.start.note_byte_read(*number);
  run.start.note_set(0);
  run.parameters[0] = run.parameters.byte(*number);
  return true;
}

bool write_byte_parameter(Run& run, const GRow&) {
  const auto number = byte_number(run);
  if (!number) return false;
  run.start.note_read(0);
  return store_byte(run, *number, run.parameters[0], 0);
}

bool force_error(Run& run, const GRow&) {
  const double number = std::round(run.parameters[1]);
  if (number == 0) return true;
  if (!(number >= 1 && number <= 999)) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0, fmt::format("P1 = {}", number));
  }
  return run.fail(error_row_of_number(static_cast<int>(number)), 0,
                  fmt::format("G997 with P1 = {}", number));
}

bool beep(Run& run, const GRow&) {
  run.events().on_message({run.origin, "BEEP"});
  return true;
}

bool force_fatal_error(Run& run, const GRow&) {
  return run.fail(ErrorCode::DivisionByZero, 0, "G999");
}

}  // namespace dripline::interpreter::centurion
