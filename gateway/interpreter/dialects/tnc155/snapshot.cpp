#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/run.hpp"

namespace dripline::interpreter::language {
template <>
inline constexpr auto kLast<tnc155::Form> = tnc155::Form::Iso;
template <>
inline constexpr auto kLast<tnc155::BlockKind> = tnc155::BlockKind::TipControl;
template <>
inline constexpr auto kLast<tnc155::Compensation> = tnc155::Compensation::Shorter;
template <>
inline constexpr auto kLast<tnc155::BlendKind> = tnc155::BlendKind::TangentialDeparture;
template <>
inline constexpr auto kLast<tnc155::JumpKind> = tnc155::JumpKind::CycleProgram;
template <>
inline constexpr auto kLast<tnc155::ProbeDirection> = tnc155::ProbeDirection::Positive;
}  // namespace dripline::interpreter::language

namespace dripline::interpreter::tnc155 {

// Not in the unnamed namespace, where the archives would not find it.
template <class Archive>
void visit(Archive& archive, State& state) {
  archive(state.phase, state.has_header, state.are_calls_checked, state.blocks, state.at,
          state.number_due, state.reading, state.program_number, state.units, state.machine,
          state.nominal, state.transformation, state.plane, state.tool, state.definitions,
          state.pockets, state.spindle, state.coolant, state.feed, state.rotary_feed,
          state.compensation, state.uses_stages, state.joins, state.is_parallel, state.needs_side,
          state.has_compensated, state.is_first_contour, state.awaits_contour, state.blend,
          state.last, state.pole, state.has_pole, state.polar, state.q, state.cycle, state.blank,
          state.labels, state.programs, state.known_labels, state.jump, state.start,
          state.is_restart, state.has_positioned, state.program_name, state.cycle_words,
          state.tool_feed, state.pole_plane, state.has_rounded, state.has_plane_angles,
          state.takes_shorter_path, state.is_rapid_next, state.beside, state.is_beside,
          state.plane_pose, state.plane_shift, state.doubtful_shift, state.known_retained,
          state.has_open_place, state.has_linear_rotary_feed);
}

namespace {

std::string_view dialect_of(const Run& run) {
  return run.options.is_itnc ? "itnc" : "tnc155";
}
constexpr std::uint32_t kVersion = 13;

bool is_plausible(const MachiningCycle& cycle) {
  return std::ranges::all_of(
      std::array{cycle.clearance, cycle.depth, cycle.peck, cycle.dwell, cycle.plunge_feed,
                 cycle.feed, cycle.first_side, cycle.second_side, cycle.radius},
      [](double value) { return std::fabs(value) <= 1e9; });
}

bool is_plausible(const State& state) {
  const bool are_levels_right = std::all_of(
      state.programs.begin(), state.programs.end(),
      [&](const ProgramFrame& frame) { return frame.label_base <= state.labels.size(); });
  return are_levels_right && state.transformation.scale != 0 && state.phase <= RunPhase::Alarmed &&
         state.labels.size() <= kMaxLabelLevels && state.programs.size() <= kMaxProgramLevels &&
         state.known_labels.size() <= kMaxLabels && state.definitions.size() <= kLastItncTool &&
         (state.q.size() == kParameterCount || state.q.size() == kAllParameters) &&
         state.cycle_words.size() <= 32 && state.pockets.size() <= kMaxStoredTools &&
         is_plausible(state.cycle.machining) && is_plausible(state.cycle.draft) &&
         state.cycle.probe.q >= 0 && state.cycle.probe.q <= 99;
}

bool is_plausible(const tilting::TiltedPath::State& tilted, const ControlOptions& options) {
  const auto kind = tilted.tilt.kind;
  return kind == tilting::Tilt::Kind::None ||
         (kind <= tilting::Tilt::Kind::TipControl && options.kinematics.exists());
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  language::StateWriter writer;
  State state = run.state;
  Origin origin = run.origin;
  std::vector<std::byte> path, corner;
  if (state.uses_stages) path = run.compensator.state();
  if (state.joins) corner = run.blender.state();
  tilting::TiltedPath::State tilted = run.tilted.state();
  writer(state, origin, path, corner, tilted);
  return {std::string(dialect_of(run)), kVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(dialect_of(run), kVersion); !kind) return kind;
  language::StateReader reader(snapshot.bytes, language::Numbers::Finite);
  State state;
  Origin origin;
  std::vector<std::byte> path, corner;
  tilting::TiltedPath::State tilted;
  reader(state, origin, path, corner, tilted);
  if (!reader.is_complete() || !is_plausible(state) || !is_plausible(tilted, run.options) ||
      state.q.size() != run.state.q.size())
    return snapshot.damage();
  const auto before = run.compensator.state();
  if (state.uses_stages) {
    if (auto restored = run.compensator.restore(path); !restored) return restored;
  } else {
    run.compensator.reset(state.machine);
  }
  if (state.joins) {
    if (auto restored = run.blender.restore(corner); !restored) {
      (void)run.compensator.restore(before);
      return restored;
    }
  } else {
    run.blender.reset(state.machine);
  }
  state.transformation.update();
  run.tilted.restore(tilted);
  run.limits.place(run.tilted.is_on()  ? run.tilted.machine()
                   : state.uses_stages ? run.compensator.sent()
                                       : state.machine);
  run.limits.reset();
  run.state = std::move(state);
  run.origin = origin;
  return {};
}

}  // namespace dripline::interpreter::tnc155
