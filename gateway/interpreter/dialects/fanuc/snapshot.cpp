#include "gateway/interpreter/dialects/fanuc/snapshot.hpp"

#include "gateway/interpreter/core/language/event_archive.hpp"

namespace dripline::interpreter::fanuc {
namespace {

using language::StateReader;
using language::StateWriter;

constexpr std::string_view kDialect = "fanuc";
constexpr std::size_t kMaxName = 16;

template <class Archive, class... Values>
void all(Archive& archive, Values&... values) {
  language::visit_all(archive, values...);
}

template <class Archive, class Value, std::size_t kCount>
void visit(Archive& archive, std::array<Value, kCount>& values) {
  for (Value& value : values) archive(value);
}
template <class Archive>
void visit(Archive& archive, TextPosition& at) {
  all(archive, at.program, at.head_seen, at.code_seen, at.segment_offset, at.segment_line,
      at.offset, at.line);
}
template <class Archive>
void visit(Archive& archive, CallFrame& frame) {
  archive(frame.kind);
  visit(archive, frame.back);
  visit(archive, frame.entry);
  visit(archive, frame.arguments);
  all(archive, frame.passes_left, frame.loop_base, frame.modal_active, frame.modal_count);
}
template <class Archive>
void visit(Archive& archive, LoopFrame& frame) {
  visit(archive, frame.head);
  visit(archive, frame.next);
  all(archive, frame.end_offset, frame.number);
}
template <class Archive>
void visit(Archive& archive, ModalCall& call) {
  all(archive, call.program, call.passes, call.outer);
  visit(archive, call.arguments);
}

template <class Archive, class Element>
void visit_list(Archive& archive, std::vector<Element>& list, std::size_t most) {
  std::size_t count = list.size();
  if (!archive.size(count, most)) return;
  list.resize(count);
  for (Element& element : list) visit(archive, element);
}

template <class Archive>
void visit_modes(Archive& archive, ModalState& state) {
  SpindleModes& spindle = state.spindle;
  all(archive, spindle.state, spindle.revolutions, spindle.surface, spindle.limit);
  all(archive, state.coolant.flood, state.coolant.mist);
  visit(archive, state.coolant.origin);
  all(archive, state.tool.pending, state.tool.is_pending, state.tool.active);
  all(archive, state.h_number, state.d_number, state.length_axis, state.length_offset);
  visit(archive, state.scaling.center);
  visit(archive, state.scaling.factor);
  Rotation& rotation = state.rotation;
  all(archive, rotation.plane, rotation.first, rotation.second, rotation.degrees, rotation.sine,
      rotation.cosine);
  CycleData& cycle = state.cycle;
  all(archive, cycle.initial, cycle.retract, cycle.bottom, cycle.depth, cycle.dwell,
      cycle.has_retract, cycle.has_bottom, cycle.has_depth);
  archive(state.zone.is_on);
  visit(archive, state.zone.low);
  visit(archive, state.zone.high);
  visit(archive, state.intermediate);
  all(archive, state.has_intermediate, state.imaginary);
  visit(archive, state.held);
  visit(archive, state.skip);
  LastWords& last = state.last;
  all(archive, last.b, last.d, last.h, last.m, last.n, last.o, last.s, last.t, last.f);
  all(archive, state.polar_angle, state.is_rigid_tapping);
}

template <class Archive>
void visit_macros(Archive& archive, ModalState& state) {
  visit_list(archive, state.locals, kMaxMacroLevels);
  visit(archive, state.commons);
  visit(archive, state.kept);
  visit(archive, state.counters);
  visit_list(archive, state.calls, kMaxFrames);
  visit_list(archive, state.loops, kMaxLoops);
  visit_list(archive, state.modals, kMaxModalCalls);
  archive(state.modal_active);
  Jump& jump = state.jump;
  all(archive, jump.kind, jump.call, jump.condition, jump.is_return, jump.loop_number, jump.modal,
      jump.number, jump.passes);
  visit(archive, jump.from);
  visit(archive, jump.arguments);
  all(archive, state.limits.jumps_back, state.limits.blocks_after_jumps);
}

template <class Archive>
void visit_state(Archive& archive, ModalState& state) {
  all(archive, state.phase, state.has_header, state.is_port_open, state.told_lower_case,
      state.speed_changed, state.blocks);
  visit(archive, state.at);
  visit(archive, state.position);
  visit(archive, state.origin);
  visit(archive, state.g);
  all(archive, state.is_transformed, state.uses_compensator, state.is_special, state.units,
      state.feed[0], state.feed[1]);
  visit_modes(archive, state);
  visit_macros(archive, state);
}

/// Only the values that are not 0: most are.
template <class Archive, std::size_t kCount>
void visit_sparse(Archive& archive, std::array<double, kCount>& values) {
  std::size_t used = 0;
  for (const double value : values) used += value != 0;
  if (!archive.size(used, kCount)) return;
  if constexpr (std::is_same_v<Archive, StateWriter>) {
    for (std::uint16_t i = 0; i < kCount; ++i) {
      if (values[i] != 0) all(archive, i, values[i]);
    }
  } else {
    for (std::size_t n = 0; n < used; ++n) {
      std::uint16_t i = 0;
      archive(i);
      if (i >= kCount) archive.damage();
      if (archive.is_damaged()) return;
      archive(values[i]);
    }
  }
}

template <class Archive>
void visit_memory(Archive& archive, Memory& memory) {
  visit_sparse(archive, memory.tools.length_geometry);
  visit_sparse(archive, memory.tools.length_wear);
  visit_sparse(archive, memory.tools.radius_geometry);
  visit_sparse(archive, memory.tools.radius_wear);
  for (AxisValues& system : memory.coordinates.work) visit_sparse(archive, system);
  visit(archive, memory.coordinates.shift);
  visit(archive, memory.coordinates.local);
  archive(memory.coordinates.more_work);
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
  return state.phase <= RunPhase::Alarmed && state.units <= Units::Millimetre &&
         state.spindle.state <= SpindleState::Oriented && is_offset(state.h_number) &&
         is_offset(state.d_number) && state.length_axis <= Axis::W &&
         state.rotation.plane <= Plane::YZ && memory.coordinates.more_work >= 1 &&
         memory.coordinates.more_work <= kMoreWorkCount && has_plausible_codes(state) &&
         has_plausible_stacks(state);
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  StateWriter writer;
  ModalState state = run.state;
  Memory memory = run.memory;
  Origin origin = run.origin;
  std::string name = run.name;
  bool is_settled = run.name_is_settled;
  std::vector<std::byte> path;
  if (state.uses_compensator) path = run.compensator.state();
  visit_state(writer, state);
  visit_memory(writer, memory);
  visit(writer, origin);
  language::visit_text(writer, name, kMaxName);
  writer(is_settled);
  language::visit_bytes(writer, path, look_ahead::kMaxStateBytes);
  return {std::string(kDialect), kSnapshotVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kSnapshotVersion); !kind) return kind;
  StateReader reader(snapshot.bytes);
  ModalState state;
  Memory memory;
  Origin origin;
  std::string name;
  bool is_settled = false;
  std::vector<std::byte> path;
  visit_state(reader, state);
  visit_memory(reader, memory);
  visit(reader, origin);
  language::visit_text(reader, name, kMaxName);
  reader(is_settled);
  language::visit_bytes(reader, path, look_ahead::kMaxStateBytes);
  if (!reader.is_complete() || !is_plausible(state, memory)) return snapshot.damage();
  if (!state.uses_compensator) {
    run.compensator.reset(state.position);
  } else if (auto restored = run.compensator.restore(path); !restored) {
    return restored;
  }
  run.state = std::move(state);
  run.memory = memory;
  run.origin = origin;
  run.name = std::move(name);
  run.name_is_settled = is_settled;
  run.update_increments();
  return {};
}

}  // namespace dripline::interpreter::fanuc
