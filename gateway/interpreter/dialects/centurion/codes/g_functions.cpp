#include "gateway/interpreter/dialects/centurion/codes/g_functions.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/codes/coordinates.hpp"
#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/codes/reference_points.hpp"
#include "gateway/interpreter/dialects/centurion/compensation/nose_compensation.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/threads.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameter_files.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr AddressSet kWordsOfAnyBlock = set_of(Address::F, Address::S);

/// Everything the control keeps as a length of the machine follows the units; the program's own
/// parameters do not (spec 7.5).
void change_units(Run& run, Units units) {
  ModalState& state = run.state;
  if (state.units == units) return;
  const double factor =
      units == Units::Millimetre ? Length::kMillimetresPerInch : 1 / Length::kMillimetresPerInch;
  Transformation& how = state.transformation;
  for (Point* point : {&state.position, &state.previous, &state.origin, &state.floating_zero,
                       &state.local_zero, &state.last_arc_center, &state.reference_via.at,
                       &how.mirror, &how.scale_center, &how.rotation_center}) {
    point->x *= factor;
    point->z *= factor;
  }
  for (double* value :
       {&state.feed[0], &state.feed[1], &state.last_arc_radius, &state.retained.radius,
        &state.retained.center_x, &state.retained.center_z}) {
    *value *= factor;
  }
  constexpr double kFeetPerMetre = 1000 / (12 * Length::kMillimetresPerInch);
  state.spindle.surface *= units == Units::Millimetre ? 1 / kFeetPerMetre : kFeetPerMetre;
  run.parameters.convert_tables(factor);
  refresh_tool(run);
  state.units = units;
  run.update_origin();
  if (state.has_header) run.events().on_units({run.origin, units});
}

bool set_data_mode(Run& run, bool on) {
  run.state.modes.takes_data = on;
  if (on) return true;
  for (const DataChange& change : run.state.data_changes) {
    note_table_set(run, change.number);
    run.parameters[change.number] = change.value;
  }
  run.state.data_changes.clear();
  run.update_origin();
  refresh_tool(run);
  run.stages_changed();
  return true;
}

bool read_byte_parameter(Run& run) {
  const double number = run.parameters[1];
  if (!(number >= 0 && number < kByteCount) || number != std::trunc(number)) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0, fmt::format("P1 = {}", number));
  }
  run.start.note_read(1);
  run.start.note_byte_read(static_cast<int>(number));
  run.start.note_set(0);
  run.parameters[0] = run.parameters.byte(static_cast<int>(number));
  return true;
}

bool write_byte_parameter(Run& run) {
  const double number = run.parameters[1];
  if (!(number >= 0 && number < kByteCount) || number != std::trunc(number)) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0, fmt::format("P1 = {}", number));
  }
  run.start.note_read(1);
  run.start.note_read(0);
  return store_byte(run, static_cast<int>(number), run.parameters[0], 0);
}

/// G997: error round(P1); 0 is none.
bool force_error(Run& run) {
  const double number = std::round(run.parameters[1]);
  if (number == 0) return true;
  if (!(number >= 1 && number <= 999)) {
    return run.fail(ErrorCode::ParameterOutOfRange, 0, fmt::format("P1 = {}", number));
  }
  return run.fail_as(error_row_of_number(static_cast<int>(number)), 0,
                     fmt::format("G997 with P1 = {}", number));
}

/// DNC FAST has neither compensation nor transformations, and takes no change of units (spec 21).
bool check_fast(Run& run, const GRow& row) {
  switch (row.code) {
    case 20:
    case 21:
      return run.fail(ErrorCode::UnitsInFast, 0, fmt::format("G{}", row.code));
    case 41:
    case 42:
    case 511:
    case 551:
    case 568:
      return run.fail(ErrorCode::NotInDnc, 0, fmt::format("G{} in FAST", row.code));
    default:
      return true;
  }
}

bool apply_g(Run& run, const GRow& row) {
  if (run.options.is_dnc_fast && !check_fast(run, row)) [[unlikely]]
    return false;
  Modes& modes = run.state.modes;
  switch (row.action) {
    case GAction::Motion:
      modes.motion = static_cast<MotionMode>(row.code);
      return true;
    case GAction::DataOn:
      return set_data_mode(run, true);
    case GAction::DataOff:
      return set_data_mode(run, false);
    case GAction::Inch:
      change_units(run, Units::Inch);
      return true;
    case GAction::Metric:
      change_units(run, Units::Millimetre);
      return true;
    case GAction::InitialLevel:
      modes.returns_to_clearance = false;
      return true;
    case GAction::ClearanceLevel:
      modes.returns_to_clearance = true;
      return true;
    case GAction::CancelToolLength:
      run.state.tool.has_no_length = true;
      return true;
    case GAction::ExactStop:
      run.block.parts.rests = true;
      return true;
    case GAction::PathMode:
      modes.path = row.code == 61   ? PathMode::ExactStop
                   : row.code == 63 ? PathMode::Tapping
                                    : PathMode::Cutting;
      if (run.state.has_header) run.events().on_override_inhibit(override_inhibit(run));
      return true;
    case GAction::SafeZone:
      modes.checks_zone = row.code == 22;
      run.stages_changed();
      return true;
    case GAction::MirrorOff:
      end_mirror(run);
      return true;
    case GAction::ScalingOff:
      end_scaling(run);
      return true;
    case GAction::RotationOff:
      end_rotation(run);
      return true;
    case GAction::Compensation:
      modes.compensation = static_cast<std::uint8_t>(row.code - 40);
      run.state.nose_is_stale = true;
      return true;
    case GAction::WorkSystem:
      modes.work_system = static_cast<std::uint8_t>(row.code - 54);
      run.update_origin();
      return true;
    case GAction::Incremental:
      modes.is_incremental = true;
      return true;
    case GAction::Absolute:
      modes.is_incremental = false;
      return true;
    case GAction::SurfaceSpeed:
      modes.is_surface_speed = true;
      return true;
    case GAction::Revolutions:
      modes.is_surface_speed = false;
      return true;
    case GAction::FeedPerMinute:
      modes.is_feed_per_revolution = false;
      return true;
    case GAction::FeedPerRevolution:
      modes.is_feed_per_revolution = true;
      return true;
    case GAction::SaveParameters:
      return save_parameters(run);
    case GAction::LoadParameters:
      return load_parameters(run);
    case GAction::ReadByte:
      return read_byte_parameter(run);
    case GAction::WriteByte:
      return write_byte_parameter(run);
    case GAction::ForceError:
      return force_error(run);
    case GAction::FatalError:
      return run.fail(ErrorCode::DivisionByZero, 0, "G999");
    case GAction::Beep:
      run.events().on_message({run.origin, "BEEP"});
      return true;
    default:
      return true;
  }
}

/// F belongs to the feed unit in force at the end of the block (spec 10.3).
bool apply_feed(Run& run) {
  const double feed = run.block.words[Address::F];
  const bool is_inch = run.state.units == Units::Inch;
  const double least = is_inch ? 0.0001 : 0.01;
  const double most = is_inch ? 999.9999 : 99999.99;
  // The metric range is one of mm/min; per revolution the least increment counts.
  const double lowest = run.state.modes.is_feed_per_revolution ? 0.0001 : least;
  if (!(feed >= lowest && feed <= most)) {
    return run.fail(ErrorCode::FeedOutOfRange, run.block.words.column(Address::F),
                    fmt::format("F{} is not in {} to {}", feed, lowest, most));
  }
  run.state.feed[run.state.modes.is_feed_per_revolution] = feed;
  return true;
}

/// S is the limit on a G50 block, else the speed of the spindle unit in force.
bool apply_speed(Run& run) {
  const double speed = run.block.words[Address::S];
  if (!(speed >= 1 && speed <= 9999)) {
    return run.fail(ErrorCode::SpindleOutOfRange, run.block.words.column(Address::S),
                    fmt::format("S{} is not in 1 to 9999", speed));
  }
  const bool is_fixed = run.action() != GAction::FloatingZero && !run.state.modes.is_surface_speed;
  if (const double most = max_revolutions(run); is_fixed && speed > most) {
    return run.fail(ErrorCode::SpindleOutOfRange, run.block.words.column(Address::S),
                    fmt::format("S{} is above {} of this spindle range", speed, most));
  }
  SpindleModes& spindle = run.state.spindle;
  if (run.action() == GAction::FloatingZero) {
    spindle.limit = speed;
  } else if (run.state.modes.is_surface_speed) {
    spindle.surface = speed;
  } else {
    spindle.revolutions = speed;
  }
  return true;
}

[[gnu::cold, gnu::noinline]] bool refuse_words(Run& run, AddressSet left) {
  const Block& block = run.block;
  for (std::size_t i = 0; i < kAddressCount; ++i) {
    const auto address = static_cast<Address>(i);
    if ((left & set_of(address)) == 0) continue;
    return run.fail(
        ErrorCode::IllegalAddress, block.words.column(address),
        fmt::format("nothing in this block takes {}{}", to_string(address), block.words[address]));
  }
  return true;
}

bool is_data_block(const Run& run) {
  const Block& block = run.block;
  if (block.parts.is_assignment_only && block.words.present() == 0) return true;
  return block.parts.g_count == 1 && block.parts.m_count == 0 && block.words.present() == 0 &&
         g_row(block.g[0]).group == ModalGroup::Data;
}

}  // namespace

bool check_words(Run& run) {
  const Block& block = run.block;
  run.ledger.open(block.words.present() & kLineWords);
  AddressSet taken = kWordsOfAnyBlock | block.parts.taken;
  if (block.parts.macro != 0 || passes_arguments(run)) return true;
  if (run.action() == GAction::MacroCall) taken = kWordsOfAnyBlock | kLineWords;
  if (block.parts.action == kNoRow) taken |= kLineWords;
  if (block.parts.jump == JumpKind::Call || block.parts.jump == JumpKind::Gosub) {
    taken |= set_of(Address::L);
  }
  for (std::uint8_t i = 0; i < block.parts.m_count; ++i) {
    if (m_row(block.m[i]).action == MAction::Call) taken |= set_of(Address::P, Address::L);
  }
  const AddressSet left = block.words.present() & ~taken;
  return left == 0 || refuse_words(run, left);
}

bool check_words_used(Run& run) {
  return refuse_words(run, static_cast<AddressSet>(run.ledger.left()));
}

bool apply_modes(Run& run) {
  const Block& block = run.block;
  if (run.state.modes.takes_data && !is_data_block(run)) [[unlikely]] {
    return run.fail(ErrorCode::IllegalG10, 0, "between G10 and G11 only P n = value");
  }
  const SpindleModes before = run.state.spindle;
  const bool was_surface_speed = run.state.modes.is_surface_speed;
  for (std::uint8_t i = 0; i < block.parts.g_count; ++i) {
    if (!apply_g(run, g_row(block.g[i]))) return false;
  }
  if (block.parts.m_count != 0) apply_spindle_range(run);
  const bool has_arguments = passes_arguments(run);
  if (block.words.has(Address::F) && !has_arguments && !takes_lead(run) && !apply_feed(run))
    return false;
  if (block.words.has(Address::S) && !has_arguments && !apply_speed(run)) return false;
  if (block.parts.tool) apply_tool(run);
  if (run.state.nose_is_stale) [[unlikely]] {
    if (!update_compensation(run)) return false;
  }
  show_speed_change(run, before, was_surface_speed);
  return true;
}

bool apply_one_shots(Run& run) {
  const Block::Parts& parts = run.block.parts;
  if (parts.dwell) {
    run.state.dwell_seconds = *parts.dwell;
    run.events().on_dwell({run.origin, *parts.dwell, {}});
    if (*parts.dwell > 0) run.loops.note_progress();
  }
  for (std::uint8_t i = 0; i < parts.g_count; ++i) {
    const GRow& row = g_row(run.block.g[i]);
    if (row.action == GAction::ClearFloatingZero) clear_floating_zero(run);
    if (row.action == GAction::Retract && !retract(run, row.code)) return false;
  }
  return set_coordinates(run);
}

}  // namespace dripline::interpreter::centurion
