#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variable_names.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

// Not in the unnamed namespace, where the archives would not find it.
template <class Archive>
void visit(Archive& archive, ModalState& state) {
  archive(state.phase, state.has_header, state.is_port_open, state.told_lower_case,
          state.speed_changed, state.blocks, state.at, state.position, state.origin, state.g,
          state.is_transformed, state.uses_compensator, state.uses_blender, state.is_special,
          state.units, state.feed, state.inverse_feed, state.spindle, state.coolant, state.tool,
          state.h_number, state.d_number, state.length_axis, state.length_offset, state.placed,
          state.length_in_axes.taken, state.length_in_axes.bare, state.length_in_axes.doubtful,
          state.length_in_axes.is_even, state.turning, state.box, state.contour, state.modes_before,
          state.rotary, state.parameters, state.enters_parameters, state.mirror, state.scaling,
          state.rotation, state.open_axes, state.opened_by, state.cycle, state.zone,
          state.intermediate, state.has_intermediate, state.imaginary, state.held, state.skip,
          state.last, state.polar_angle, state.polar_radius, state.offset_list,
          state.is_rigid_tapping, state.locals, state.commons, state.kept, state.extra,
          state.variable_names, state.counters, state.calls, state.loops, state.modals,
          state.modal_active, state.jump, state.limits);
}

namespace {

std::string_view dialect_of(const Run& run) {
  return run.options.is_lathe ? "fanuc-t" : "fanuc";
}
constexpr std::uint32_t kVersion = 16;

template <class Archive>
void visit_memory(Archive& archive, Memory& memory) {
  const auto visit_sparse = [&](auto& values) {
    language::visit_sparse(archive, values.size(),
                           [&](std::size_t i) -> double& { return values[i]; });
  };
  visit_sparse(memory.tools.length_geometry);
  visit_sparse(memory.tools.length_wear);
  visit_sparse(memory.tools.radius_geometry);
  visit_sparse(memory.tools.radius_wear);
  visit_sparse(memory.tools.x_geometry);
  visit_sparse(memory.tools.x_wear);
  visit_sparse(memory.tools.tip);
  for (AxisValues& system : memory.coordinates.work) visit_sparse(system);
  archive(memory.coordinates.shift, memory.coordinates.local, memory.coordinates.more_work);
}

bool is_offset(int number) {
  return number >= 0 && number <= kMaxOffsets;
}

/// Each code must be one of its group: tables and offsets are found by it.
bool has_plausible_codes(const ModalState& state) {
  for (std::size_t group = 1; group < kGroupCount; ++group) {
    if (group_of(state.g[group]) != group) return false;
  }
  return true;
}

bool has_plausible_stacks(const ModalState& state) {
  if (state.calls.size() > kMaxFrames || state.loops.size() > kMaxLoops ||
      (!state.extra.empty() && state.extra.size() != kExtraCount) ||
      (!state.variable_names.empty() && state.variable_names.size() != kNamedCount) ||
      state.modals.size() > kMaxModalCalls || state.locals.size() > kMaxMacroLevels) {
    return false;
  }
  const auto is_modal = [&](int index) {
    return index >= -1 && index < static_cast<int>(state.modals.size());
  };
  std::size_t levels = 1;
  for (const CallFrame& frame : state.calls) {
    if (frame.kind > CallKind::Code || !is_modal(frame.modal_active)) return false;
    levels += frame.kind != CallKind::Subprogram;
  }
  for (const ModalCall& call : state.modals) {
    if (!is_modal(call.outer)) return false;
  }
  for (const LoopFrame& loop : state.loops) {
    if (loop.number < 1 || loop.number > 3) return false;
  }
  const Jump& jump = state.jump;
  return state.locals.size() == levels && is_modal(state.modal_active) && is_modal(jump.modal) &&
         jump.kind <= JumpKind::Call && jump.call <= CallKind::Code && jump.passes >= 1 &&
         jump.loop_number <= 3;
}

/// Values that index tables must be in range, whatever the bytes say.
bool is_plausible(const ModalState& state, const Memory& memory) {
  if (state.rotary.kind > RotaryPlane::Kind::Cylinder || state.opened_by > FrameCode::MirrorEnd)
    return false;
  if (state.contour.code != 0 && (state.contour.code < 170 || state.contour.code > 173)) {
    return false;
  }
  if (state.uses_blender && !state.uses_compensator) return false;
  return state.phase <= RunPhase::Alarmed && is_offset(state.h_number) &&
         is_offset(state.d_number) && memory.coordinates.more_work >= 1 &&
         memory.coordinates.more_work <= kMoreWorkCount && has_plausible_codes(state) &&
         has_plausible_stacks(state);
}

bool is_plausible(const TiltedPath::State& tilted, const ControlOptions& options) {
  const Tilt::Kind kind = tilted.tilt.kind;
  return kind == Tilt::Kind::None ||
         (kind <= Tilt::Kind::TipControl && options.kinematics.exists());
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  language::StateWriter writer;
  ModalState state = run.state;
  Memory memory = run.memory;
  Origin origin = run.origin;
  std::string name = run.name;
  bool is_settled = run.name_is_settled;
  std::vector<std::byte> path;
  if (state.uses_compensator) path = run.compensator.state();
  RotaryPath::State rotary = run.rotary.state();
  std::vector<std::byte> corners;
  if (state.uses_blender) corners = run.blender.state();
  writer(state);
  visit_memory(writer, memory);
  TiltedPath::State tilted = run.tilted.state();
  writer(origin, name, is_settled, rotary, tilted, path, corners);
  return {std::string(dialect_of(run)), kVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(dialect_of(run), kVersion); !kind) return kind;
  language::StateReader reader(snapshot.bytes);
  ModalState state;
  Memory memory;
  Origin origin;
  std::string name;
  bool is_settled = false;
  std::vector<std::byte> path;
  RotaryPath::State rotary;
  TiltedPath::State tilted;
  std::vector<std::byte> corners;
  reader(state);
  visit_memory(reader, memory);
  reader(origin, name, is_settled, rotary, tilted, path, corners);
  if (!reader.is_complete() || !is_plausible(state, memory) ||
      rotary.plane.kind != state.rotary.kind || !is_plausible(tilted, run.options)) {
    return snapshot.damage();
  }
  if (!state.uses_compensator) {
    run.compensator.reset(state.position);
  } else if (auto restored = run.compensator.restore(path); !restored) {
    return restored;
  }
  if (!state.uses_blender) {
    run.blender.reset(state.position);
  } else if (auto restored = run.blender.restore(corners); !restored) {
    return restored;
  }
  run.rotary.restore(rotary);
  run.tilted.restore(tilted);
  run.state = std::move(state);
  run.memory = memory;
  run.origin = origin;
  run.name = std::move(name);
  run.name_is_settled = is_settled;
  run.update_increments();
  run.lead_stages();
  return {};
}

}  // namespace dripline::interpreter::fanuc
