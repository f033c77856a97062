#include "gateway/interpreter/dialects/fanuc/execution/coordinates.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/length_in_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/parameters.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {

namespace {

/// `use(index, value)` for every axis word of the block.
template <class Use>
void each_axis_word(const Run& run, Use use) {
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const Address address = kWordOfAxis[i];
    if (run.block.words.has(address)) {
      use(i, run.coordinate(static_cast<Axis>(i), run.block.words[address]));
    }
  }
}

bool refuse_transformed(Run& run, const DiagnosticRow& code) {
  const bool is_mirror = run.state.mirror.any();
  return run.fail(code, run.block.parts.g_column,
                  is_mirror ? std::string_view("G51.1 is in force") : std::string_view{});
}

/// U, V, W and H of G-code system A, which add to the zero offset of their axis.
bool add_increments(Run& run, AxisValues& offset) {
  struct IncrementWord {
    Address increment, absolute;
    Axis axis;
    bool exists;
  };
  const std::array rows{IncrementWord{Address::U, Address::X, Axis::X, true},
                        IncrementWord{Address::V, Address::Y, Axis::Y, run.options.has_y_axis},
                        IncrementWord{Address::W, Address::Z, Axis::Z, true},
                        IncrementWord{Address::H, Address::C, Axis::C, run.options.has_c_axis}};
  const Words& words = run.block.words;
  for (const IncrementWord& row : rows) {
    if (!words.has(row.increment)) continue;
    const std::uint32_t column = words.column(row.increment);
    if (run.options.code_system != CodeSystem::A) {
      return run.fail(ErrorCode::ImproperCommand, column,
                      "zero offsets are written with X, Y, Z and C in this G-code system");
    }
    if (!row.exists) {
      return run.fail(ErrorCode::ImproperCommand, column,
                      fmt::format("{} is no axis of this lathe", letter(row.axis)));
    }
    if (words.has(row.absolute)) {
      return run.fail(
          ErrorCode::ImproperCommand, column,
          fmt::format("{} and {} in one block", letter(row.absolute), letter(row.increment)));
    }
    offset[static_cast<std::size_t>(row.axis)] += run.coordinate(row.axis, words[row.increment]);
  }
  return true;
}

/// G10 L2 and L20: zero offsets.
bool set_work_offset(Run& run, bool more) {
  const Words& words = run.block.words;
  if (!words.has(P)) return run.fail(ErrorCode::IllegalPInG10, run.block.parts.g_column, "no P");
  const double number = run.whole(words[P]);
  const double most = more ? kMoreWorkCount : 6;
  if (!(number >= (more ? 1 : 0) && number <= most)) {
    return run.fail(ErrorCode::IllegalPInG10, words.column(P), fmt::format("P{}", number));
  }
  const auto system = static_cast<std::size_t>(number) + (more ? 6 : 0);
  AxisValues& offset = run.memory.coordinates.work[system];
  AxisValues changed = offset;
  if (run.options.is_lathe && !add_increments(run, changed)) return false;
  const bool adds = run.state.is_incremental();
  each_axis_word(run, [&](std::size_t i, double value) {
    if (run.options.is_lathe && kWordOfAxis[i] >= U && kWordOfAxis[i] <= W) return;
    changed[i] = adds ? changed[i] + value : value;
  });
  offset = changed;
  interrupt_compensation(run);
  run.update_origin();
  resume_compensation(run);
  return true;
}

/// A code of the block that has a use of its own for P.
bool has_other_user_of_p(const Block& block) {
  const Block::Parts& parts = block.parts;
  if (parts.one_shot == 4 || parts.one_shot == 10 || parts.one_shot == 30) return true;
  if (block.names(kScalingGroup) && block.g[kScalingGroup] == 51) return true;
  if (block.names(kRotationGroup) && block.g[kRotationGroup] == kTiltedPlane) return true;
  if (block.names(kLengthGroup) && is_tip_control(block.g[kLengthGroup])) return true;
  if (block.names(kSpindleGroup) && block.g[kSpindleGroup] == 96) return true;
  if (block.names(kCycleGroup) && block.g[kCycleGroup] != 80) return true;
  return std::any_of(block.m.begin(), block.m.begin() + parts.m_count,
                     [](int code) { return code == 98 || code == 99 || code == 198; });
}

/// G54 P is G54.1 P where the control has those systems. A block in which P could be another
/// code's as well is not guessed at.
bool read_page(Run& run, std::uint8_t& code) {
  Block& block = run.block;
  const Words& words = block.words;
  const bool has_pages = run.options.has_pages;
  if (code == kMoreWorkSystems && !has_pages) {
    return run.fail(ErrorCode::ImproperG, block.parts.g_column, "G54.1 on this model");
  }
  if ((code != kMoreWorkSystems && code != 54) || !words.has(P)) return true;
  const double number = run.whole(words[P]);
  if (has_other_user_of_p(block)) {
    if (code == 54 && (!has_pages || number > kMoreWorkCount)) return true;
    return run.fail(ErrorCode::ImproperCommand, words.column(P),
                    fmt::format("P{} is of G54 as well as of another code", number));
  }
  if (!has_pages) {
    if (run.state.is_cycle()) return true;
    return run.fail(ErrorCode::ImproperCommand, words.column(P), "G54 takes no P on this model");
  }
  block.parts.p_is_work_system = true;
  code = kMoreWorkSystems;
  return true;
}

}  // namespace

bool select_work_system(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  std::uint8_t code = run.block.g[kWorkGroup];
  if (state.is_transformed) return refuse_transformed(run, ErrorCode::RotationOffset);
  if (!read_page(run, code)) return false;
  if (code == kMoreWorkSystems) {
    const double number = words.has(P) ? run.whole(words[P]) : 1;
    if (!(number >= 1 && number <= kMoreWorkCount)) {
      return run.fail(ErrorCode::IllegalPInG10, words.column(P), fmt::format("G54.1 P{}", number));
    }
    run.memory.coordinates.more_work = static_cast<int>(number);
  }
  interrupt_compensation(run);
  state.g[kWorkGroup] = code;
  run.update_origin();
  resume_compensation(run);
  return true;
}

bool set_local_zero(Run& run) {
  run.ledger.take(kAxisWords);
  if (run.state.is_transformed) return refuse_transformed(run, ErrorCode::RotationOffset);
  // Some controls of this language add to the local zero in G91, others set it there too.
  AxisValues& local = run.memory.coordinates.local;
  std::uint32_t doubtful = 0;
  each_axis_word(run, [&](std::size_t i, double) {
    if (run.state.is_incremental() && local[i] != 0 && doubtful == 0)
      doubtful = run.block.words.column(kWordOfAxis[i]);
  });
  if (doubtful != 0) {
    return run.fail(ErrorCode::ImproperCommand, doubtful,
                    "G52 in G91 where there is a local zero: G90 comes before it");
  }
  interrupt_compensation(run);
  each_axis_word(run, [&](std::size_t i, double value) { local[i] = value; });
  run.update_origin();
  resume_compensation(run);
  return true;
}

bool set_position(Run& run) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  if (!words.has_any(kAxisWords)) return true;  // G92 S
  run.ledger.take(kAxisWords);
  if (state.is_transformed) return refuse_transformed(run, ErrorCode::PositionUnderTransform);
  interrupt_compensation(run);
  note_set_axes(run);
  Coordinates& all = run.memory.coordinates;
  each_axis_word(run, [&](std::size_t i, double value) {
    const auto axis = static_cast<Axis>(i);
    // The local zero of the axis goes; what is left makes this place `value`. Positions leave the
    // tool's length out already, so that they are those of the tip.
    const double without = state.origin[i] - all.shift[i] - all.local[i];
    all.local[i] = 0;
    all.shift[i] = state.position.raw(axis) - without - value;
  });
  run.update_origin();
  resume_compensation(run);
  return true;
}

bool preset_coordinates(Run& run) {
  const Words& words = run.block.words;
  run.ledger.take(kAxisWords);
  if (run.state.is_transformed) return refuse_transformed(run, ErrorCode::PositionUnderTransform);
  if (!words.has_any(kAxisWords)) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column, "no axis is named");
  }
  std::uint32_t bad = 0;
  each_axis_word(run, [&](std::size_t i, double value) {
    if (value != 0 && bad == 0) bad = words.column(kWordOfAxis[i]);
  });
  if (bad != 0) return run.fail(ErrorCode::ImproperCommand, bad, "the axes are named with 0");
  interrupt_compensation(run);
  Coordinates& all = run.memory.coordinates;
  each_axis_word(run, [&](std::size_t i, double) { all.shift[i] = all.local[i] = 0; });
  run.update_origin();
  resume_compensation(run);
  return true;
}

bool set_data(Run& run) {
  const Words& words = run.block.words;
  const double list = words.has(L) ? run.whole(words[L]) : 1;
  if (list == 50 || list == 52) return begin_parameters(run);
  if (list == 2 || list == 20) {
    if (run.state.is_transformed) return refuse_transformed(run, ErrorCode::RotationOffset);
    run.ledger.take(kAxisWords | set_of(L));
    return set_work_offset(run, list == 20);
  }
  if (run.options.is_lathe && list == 1) return set_turret_offset(run);
  run.ledger.take(set_of(L, R));
  if (list == 1 || (list >= 10 && list <= 13)) return set_offset_data(run, static_cast<int>(list));
  return run.fail(ErrorCode::IllegalPInG10, words.column(L), fmt::format("G10 L{}", list));
}

namespace {

/// One corner of the zone alone, that would be beyond the stored other one.
bool refuse_zone(Run& run, std::size_t axis) {
  const StrokeZone& zone = run.state.zone;
  return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column,
                  fmt::format("G22: {} {:.4f} mm is below {} {:.4f} mm", letter(kAllAxes[axis]),
                              zone.high[axis], "IJK"[axis], zone.low[axis]));
}

}  // namespace

bool set_stroke_zone(Run& run) {
  ModalState& state = run.state;
  const std::uint8_t code = run.block.g[kStrokeGroup];
  state.g[kStrokeGroup] = code;
  state.zone.is_on = false;
  if (code == 23) return true;
  run.ledger.take(set_of(X, Y, Z, I, J, K));
  constexpr std::array<Address, 3> kOneCorner{X, Y, Z};
  constexpr std::array<Address, 3> kOther{I, J, K};
  for (std::size_t i = 0; i < 3; ++i) {
    const Words& words = run.block.words;
    if (words.has(kOneCorner[i]))
      state.zone.high[i] = run.coordinate(static_cast<Axis>(i), words[kOneCorner[i]]);
    if (words.has(kOther[i]))
      state.zone.low[i] = run.coordinate(static_cast<Axis>(i), words[kOther[i]]);
    if (state.zone.low[i] <= state.zone.high[i]) continue;
    if (!words.has(kOneCorner[i]) || !words.has(kOther[i])) return refuse_zone(run, i);
    std::swap(state.zone.low[i], state.zone.high[i]);
  }
  state.zone.is_on = state.zone.has_volume();
  return true;
}

namespace {

bool names_axis(const Run& run, Axis axis) {
  return (run.block.words.present() & set_of_axis(axis)) != 0;
}

bool check_reference(Run& run) {
  constexpr double kAtReference = 1e-6;
  Position to;
  if (!read_target(run, to) || !rapid_to(run, to)) return false;
  for (const Axis axis : kAllAxes) {
    if (!names_axis(run, axis)) continue;
    const double reference = run.options.reference[0][static_cast<std::size_t>(axis)];
    if (std::fabs(run.state.position.raw(axis) - reference) <= kAtReference) continue;
    return run.fail(ErrorCode::NotAtReference, run.block.words.first_column(set_of_axis(axis)),
                    fmt::format("{}", letter(axis)));
  }
  return true;
}

bool moves_in_plane(const Run& run, const Position& to) {
  const PlaneAxes axes = axes_of(run.state.plane());
  const Position& from = run.state.position;
  return to.raw(axes.first) != from.raw(axes.first) || to.raw(axes.second) != from.raw(axes.second);
}

/// The intermediate point is reached with the compensation's vector, the reference point without.
/// It is kept in program coordinates: a change of zero before G29 shifts it.
bool return_to(Run& run, std::size_t point) {
  ModalState& state = run.state;
  Position to;
  if (!read_target(run, to)) return false;
  interrupt_compensation(run, moves_in_plane(run, to));
  for (const Axis axis : kAllAxes) {
    if (!names_axis(run, axis)) continue;
    const auto i = static_cast<std::size_t>(axis);
    state.intermediate[i] = to.raw(axis) - state.origin[i];
    state.has_intermediate = static_cast<std::uint16_t>(state.has_intermediate | 1u << i);
  }
  if (!rapid_to(run, to)) return false;
  Position home = state.position;
  for (const Axis axis : kAllAxes) {
    if (!names_axis(run, axis)) continue;
    home.set_raw(axis, run.options.reference[point][static_cast<std::size_t>(axis)]);
    state.placed.set_raw(axis, home.raw(axis));
  }
  note_machine_axes(run);
  return rapid_to(run, home);
}

/// Through the point remembered, which is also where increments count from.
bool come_back(Run& run) {
  ModalState& state = run.state;
  Position middle = state.position;
  bool is_known = true;
  for (const Axis axis : kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    if (!names_axis(run, axis)) continue;
    if ((state.has_intermediate >> i & 1u) == 0) {
      is_known = false;
      continue;
    }
    middle.set_raw(axis, state.intermediate[i] + state.origin[i]);
  }
  if (!is_known) run.warn(WarningCode::ReturnWithoutReference, run.block.parts.g_column);
  if (!rapid_to(run, middle)) return false;
  Position to;
  return read_target(run, to) && rapid_to(run, to);
}

}  // namespace

bool execute_reference(Run& run) {
  const ModalState& state = run.state;
  const Words& words = run.block.words;
  const std::uint32_t column = run.block.parts.g_column;
  if (state.is_cycle()) return run.fail(ErrorCode::HomeInCycle, column);
  if (state.is_transformed) return run.fail(ErrorCode::RotationHome, column);
  if (!words.has_any(kAxisWords)) return true;
  run.ledger.take(kAxisWords);
  switch (run.block.parts.one_shot) {
    case 27:
      interrupt_compensation(run);
      return check_reference(run);
    case 28:
      return return_to(run, 0);
    case 29:
      interrupt_compensation(run);
      return come_back(run);
    default:
      break;
  }
  const double point = words.has(P) ? run.whole(words[P]) : 2;
  if (!(point >= 2 && point <= 4)) {
    return run.fail(ErrorCode::IllegalReference, words.column(P), fmt::format("P{}", point));
  }
  return return_to(run, static_cast<std::size_t>(point) - 1);
}

}  // namespace dripline::interpreter::fanuc
