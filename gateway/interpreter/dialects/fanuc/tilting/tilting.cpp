#include "gateway/interpreter/dialects/fanuc/tilting/tilting.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/rotary_plane.hpp"
#include "gateway/interpreter/dialects/fanuc/tilting/planes.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Why the mode cannot begin, or nothing.
std::string_view hindrance(const Run& run) {
  const ModalState& state = run.state;
  if (run.tilted.kind() == Tilt::Kind::Plane) return "G68.2 is in force; G69 ends it";
  if (run.tilted.kind() == Tilt::Kind::TipControl) return "G43.4 or G43.5 is in force; G49 ends it";
  if (state.is_compensating()) return "cutter compensation is on";
  if (state.is_cycle()) return "a hole cycle is in force";
  if (state.is_transformed) return "G51, G51.1 or G68 is in force";
  if (state.is_polar()) return "G16 is in force";
  if (state.imaginary != 0) return "an axis is imaginary by G07";
  if (run.rotary.is_on()) return "G12.1 or G07.1 is in force";
  if (state.length_axis != Axis::Z && state.length_offset != 0)
    return "the tool's length is compensated along another axis than Z";
  return {};
}

/// Moves that wait are made, and the header is delivered.
bool flush_stages(Run& run) {
  run.events();
  if (!end_waiting(run)) return false;
  if (run.state.uses_compensator) run.compensator.flush();
  return check_compensation(run);
}

/// From here on the program's places are those of another frame.
void change_frame(Run& run) {
  ++run.frame_changes;
  run.place_stages();
}

void begin(Run& run, Tilt tilt) {
  ModalState& state = run.state;
  const Kinematics& machine = run.options.kinematics;
  for (std::size_t i = 0; i < 3; ++i) tilt.flat_zero[i] = state.origin[i];
  const auto zero_of = [&state](const RotaryAxis& rotary) {
    return state.origin[static_cast<std::size_t>(rotary.axis)];
  };
  tilt.zero = {zero_of(machine.master), zero_of(machine.slave)};
  if (tilt.kind == Tilt::Kind::TipControl && machine.begins_at_present)
    tilt.zero = pose_of(machine, state.position);
  tilt.length = state.length_offset;
  tilt.mm_per_unit = run.increments.mm_per_unit;
  run.tilted.begin(tilt, state.position);
  state.position = run.tilted.flat();
  change_frame(run);
}

void end(Run& run) {
  run.state.position = run.tilted.machine();
  run.tilted.end();
  change_frame(run);
}

/// A code of the block that the mode excludes: its name, or nothing.
std::string_view excluded_code(const Run& run) {
  const Block& block = run.block;
  const auto names = [&block](Group group, auto... codes) {
    return block.names(group) && ((block.g[group] == codes) || ...);
  };
  if (names(kScalingGroup, 51)) return "G51";
  if (names(kMirrorGroup, kMirrorOn)) return "G51.1";
  if (names(kRotationGroup, 68)) return "G68";
  if (names(kRotationGroup, kTiltedPlane)) return "G68.2";
  if (names(kLengthGroup, kTipControl)) return "G43.4";
  if (names(kLengthGroup, kTipVector)) return "G43.5";
  if (names(kInterpolationGroup, kPolarPlaneOn)) return "G12.1";
  if (names(kStrokeGroup, 22)) return "G22";
  if (block.names(kWorkGroup)) return "a change of the work system";
  if (names(kUnitsGroup, 20, 21) &&
      (block.g[kUnitsGroup] == 20) != (run.state.units == Units::Inch))
    return "a change of units";
  return {};
}

/// The same of a code that acts in its block only.
std::string_view excluded_shot(const Run& run) {
  const Block& block = run.block;
  switch (block.parts.one_shot) {
    case Block::kNoCode:
    case 4:
    case 5:
    case 8:
    case 9:
    case 65:
    case kContourControl:
    case kAxisDirection:
      return {};
    case 39:
      return run.tilted.kind() == Tilt::Kind::Plane ? std::string_view{} : "G39";
    case 10: {
      const double list = block.words.has(L) ? run.whole(block.words[L]) : 1;
      return list == 1 || (list >= 10 && list <= 13) ? std::string_view{} : "G10 of coordinates";
    }
    default:
      return "this G code";
  }
}

/// What else tool center point control excludes.
std::string_view excluded_by_tip_control(const Run& run) {
  const Block& block = run.block;
  const auto in_force = [&](Group group) {
    return block.names(group) ? block.g[group] : run.state.g[group];
  };
  if (block.parts.one_shot == kAxisDirection) return "G53.1";
  if (in_force(kMotionGroup) > 1 && block.words.has_any(kAxisWords | kCenterWords))
    return "a move by another code than G00 and G01";
  if (in_force(kCompensationGroup) != 40) return "cutter compensation";
  if (in_force(kCycleGroup) != 80) return "a hole cycle";
  if (in_force(kPolarGroup) == 16) return "G16";
  if (in_force(kFeedGroup) == 95) return "feed per revolution";
  const bool by_vector = run.state.g[kLengthGroup] == kTipVector;
  if (!by_vector && block.words.has_any(kCenterWords))
    return "I, J, K, which are a tool's direction in G43.5,";
  if (by_vector && block.words.has_any(kRotaryWords)) return "a rotary word";
  if (by_vector && block.words.has(Q)) return "Q";
  if (block.parts.corner != CornerKind::None) return "a corner word";
  return {};
}

bool refuse_excluded(Run& run, std::string_view excluded) {
  const bool is_plane = run.tilted.kind() == Tilt::Kind::Plane;
  const std::string_view mode = is_plane                                  ? "G68.2"
                                : run.state.g[kLengthGroup] == kTipVector ? "G43.5"
                                                                          : "G43.4";
  return run.fail_at_g(is_plane ? ErrorCode::ImproperCommand : ErrorCode::TipControl,
                       fmt::format("{} while {} is in force", excluded, mode));
}

}  // namespace

namespace {

/// An axis beside X, Y and Z moves the tip too, and is in no kinematics.
constexpr AddressSet kParallelWords = set_of(U, V, W);

bool refuse_parallel(Run& run, const DiagnosticRow& code) {
  return run.fail(code, run.block.words.first_column(kParallelWords),
                  "U, V and W move the tool's tip and are in no kinematics");
}

/// Where one is when the plane or the tip control begins would be left out, too.
bool is_beside(const Run& run) {
  const interpreter::Position& at = run.state.position;
  return at.raw(Axis::U) != 0 || at.raw(Axis::V) != 0 || at.raw(Axis::W) != 0;
}

}  // namespace

bool check_tilted_block(Run& run) {
  const Block& block = run.block;
  const bool is_plane = run.tilted.kind() == Tilt::Kind::Plane;
  std::string_view excluded = excluded_code(run);
  if (excluded.empty()) excluded = excluded_shot(run);
  if (excluded.empty() && !is_plane) {
    excluded = excluded_by_tip_control(run);
    if (block.names(kLengthGroup) && block.g[kLengthGroup] != 49) excluded = "G43 or G44";
    if (block.words.has(H)) excluded = "H";
  }
  if (!excluded.empty()) return refuse_excluded(run, excluded);
  const bool is_data = block.parts.one_shot == 4 || block.parts.one_shot == 10;
  const bool is_call = block.parts.kind == BlockKind::Call;
  if (is_plane && !is_data && !is_call && block.words.has_any(kRotaryWords)) {
    return run.fail(ErrorCode::ImproperCommand, block.words.first_column(kRotaryWords),
                    "a rotary axis while G68.2 is in force; G53.1 moves them");
  }
  if (!is_data && !is_call && block.words.has_any(kParallelWords))
    return refuse_parallel(run, is_plane ? ErrorCode::ImproperCommand : ErrorCode::TipControl);
  return true;
}

bool begin_tilted_plane(Run& run) {
  if (const std::string_view why = hindrance(run); !why.empty())
    return run.fail_at_g(ErrorCode::PlaneFormat, why);
  if (is_beside(run)) return run.fail_at_g(ErrorCode::PlaneFormat, "U, V or W is not at 0");
  Tilt tilt{.kind = Tilt::Kind::Plane};
  if (!read_plane(run, tilt) || !flush_stages(run)) return false;
  begin(run, tilt);
  return true;
}

bool end_tilted_plane(Run& run) {
  if (run.state.is_compensating() || run.state.is_cycle()) {
    return run.fail_at_g(ErrorCode::ImproperCommand,
                         "G69 of a tilted plane needs G40 and G80 before it");
  }
  if (!flush_stages(run)) return false;
  end(run);
  return true;
}

bool begin_tip_control(Run& run) {
  const Words& words = run.block.words;
  if (!words.has(H)) return run.fail_at_g(ErrorCode::TipControl, "H is needed");
  if (words.has_any(kParallelWords)) return refuse_parallel(run, ErrorCode::TipControl);
  if (is_beside(run)) return run.fail_at_g(ErrorCode::TipControl, "U, V or W is not at 0");
  if (words.has(P) && run.block.parts.m_count == 0 && run.whole(words[P]) != 0) {
    return run.fail(
        ErrorCode::TipControl, words.column(P),
        fmt::format("P{}: the tool's posture is not controlled here", run.whole(words[P])));
  }
  if (const std::string_view why = hindrance(run); !why.empty())
    return run.fail_at_g(ErrorCode::TipControl, why);
  if (!flush_stages(run)) return false;
  Tilt tilt{.kind = Tilt::Kind::TipControl};
  for (std::size_t i = 0; i < 3; ++i) tilt.at[i] = run.state.origin[i];
  begin(run, tilt);
  std::string_view excluded = excluded_shot(run);
  if (excluded.empty()) excluded = excluded_by_tip_control(run);
  return excluded.empty() || refuse_excluded(run, excluded);
}

bool end_tip_control(Run& run) {
  if (!flush_stages(run)) return false;
  end(run);
  return true;
}

bool follow_length_offset(Run& run) {
  if (run.state.length_axis != Axis::Z && run.state.length_offset != 0) {
    return run.fail_at_g(ErrorCode::ImproperCommand,
                         "in a tilted plane the tool's length is compensated along Z");
  }
  if (run.state.length_offset == run.tilted.length_in_force()) return true;
  // Moves that still wait are those of the length before.
  if (run.options.kinematics.type != KinematicType::TableTable) {
    if (run.state.is_compensating())
      return run.fail_at_g(ErrorCode::ImproperCommand,
                           "the tool's length changes in cutter compensation; G40 comes before it");
    if (!flush_stages(run)) return false;
  }
  run.tilted.set_length(run.state.length_offset);
  return true;
}

bool take_length_offset(Run& run) {
  const ModalState& state = run.state;
  const bool waits = !state.position.same_point(run.tilted.flat());
  if (run.tilted.kind() != Tilt::Kind::Plane || waits || !run.tilted.lags()) return true;
  const std::uint8_t mode = state.g[kMotionGroup];
  if (mode > 1 && !state.is_cycle()) {
    return run.fail_at_g(ErrorCode::ImproperCommand,
                         "G00 or G01 is needed for the move by the tool's length");
  }
  const bool is_fed = mode == 1 && !state.is_cycle();
  if (is_fed && !check_feed(run)) return false;
  const std::optional<Feed> feed = is_fed ? std::optional(run.active_feed()) : std::nullopt;
  run.events();
  run.tilted.take_length(run.origin, feed, run.rests_at_end());
  run.block.parts.has_motion = true;
  return true;
}

bool aim_tool(Run& run, Position& to) {
  const Words& words = run.block.words;
  if (run.state.g[kLengthGroup] != kTipVector || !words.has_any(kCenterWords)) return true;
  constexpr std::array<Address, 3> kComponents{I, J, K};
  run.ledger.take(kCenterWords);
  Point3 direction{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.has(kComponents[i])) continue;
    const Word& word = words[kComponents[i]];  // of a direction: more decimals than a length has
    direction[i] =
        word.form == WordForm::Whole ? run.length(word) : word.value * run.increments.mm_per_unit;
  }
  const double size = length(direction);
  const std::uint32_t column = words.first_column(kCenterWords);
  if (!(size > 0)) return run.fail(ErrorCode::TipControl, column, "I, J, K are no direction");
  const auto pose = run.tilted.pose_for((1 / size) * direction);
  if (!pose) {
    return run.fail(ErrorCode::TipControl, column,
                    "no position of the rotary axes brings the tool along I, J, K");
  }
  const Kinematics& machine = run.options.kinematics;
  to.set_raw(machine.master.axis, pose->master);
  to.set_raw(machine.slave.axis, pose->slave);
  return true;
}

bool direct_tool_axis(Run& run) {
  const ModalState& state = run.state;
  const Words& words = run.block.words;
  constexpr AddressSet kOthers = kAxisWords | kCenterWords | set_of(P, Q, R, H, D, L);
  if (run.tilted.kind() != Tilt::Kind::Plane)
    return run.fail_at_g(ErrorCode::AxisDirection, "G68.2 is not in force");
  if (words.has_any(kOthers)) {
    return run.fail(ErrorCode::AxisDirection, words.first_column(kOthers),
                    "a word beside G53.1, which takes none");
  }
  if (state.is_compensating() || state.is_cycle())
    return run.fail_at_g(ErrorCode::AxisDirection, "G40 and G80 come before it");
  if (state.g[kMotionGroup] > 1)
    return run.fail_at_g(ErrorCode::AxisDirection, "G00 or G01 is needed for its move");
  const bool is_fed = state.g[kMotionGroup] == 1;
  if (is_fed && !check_feed(run)) return false;
  const auto pose = run.tilted.pose_for({0, 0, 1});
  if (!pose) {
    return run.fail_at_g(ErrorCode::AxisDirection,
                         "no position of the rotary axes brings the tool normal to the plane");
  }
  if (!flush_stages(run)) return false;
  const std::optional<Feed> feed = is_fed ? std::optional(run.active_feed()) : std::nullopt;
  run.tilted.turn_to(run.origin, *pose, feed, run.rests_at_end());
  if (!check_last_stage(run)) return false;
  run.block.parts.has_motion = true;
  arrive(run, run.tilted.flat());
  change_frame(run);
  return true;
}

}  // namespace dripline::interpreter::fanuc
