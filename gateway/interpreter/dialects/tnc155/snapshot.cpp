#include "gateway/interpreter/dialects/tnc155/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/language/event_archive.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

using language::StateReader;
using language::StateWriter;
using language::visit_all;

constexpr std::string_view kDialect = "tnc155";

template <class Archive, class Value, std::size_t kCount>
void visit_values(Archive& archive, std::array<Value, kCount>& values) {
  for (Value& value : values) archive(value);
}
template <class Archive, class Value>
void visit_optional(Archive& archive, std::optional<Value>& value, Value last) {
  bool has = value.has_value();
  archive(has);
  Value held = value.value_or(Value{});
  if (has) up_to(archive, held, last);
  value = has ? std::optional(held) : std::nullopt;
}
template <class Archive>
void visit(Archive& archive, ProgramForm& form) {
  up_to(archive, form.form, Form::Iso);
  up_to(archive, form.units, Units::Millimetre);
  archive(form.number);
}
template <class Archive>
void visit(Archive& archive, ToolDefinition& tool) {
  archive(tool.number);
  visit(archive, tool.data.length);
  visit(archive, tool.data.radius);
}
template <class Archive>
void visit(Archive& archive, ToolPocket& tool) {
  bool has_pocket = tool.pocket.has_value();
  int pocket = tool.pocket.value_or(0);
  visit_all(archive, tool.tool, tool.is_special, has_pocket, pocket);
  tool.pocket = has_pocket ? std::optional(pocket) : std::nullopt;
}
template <class Archive>
void visit(Archive& archive, LabelFrame& frame) {
  visit_all(archive, frame.is_repeat, frame.label, frame.left, frame.from);
  visit(archive, frame.call);
  visit(archive, frame.back);
}
template <class Archive>
void visit_reading(Archive& archive, ReadingState& reading) {
  visit(archive, reading.program);
  IsoModes& iso = reading.iso;
  visit_all(archive, iso.motion, iso.has_plane, iso.has_compensation, iso.has_distance,
            iso.is_incremental);
  visit_optional(archive, iso.last_turn, Turn::Counterclockwise);
  visit_optional(archive, reading.last_path, BlockKind::Probe);
  up_to(archive, reading.last_turn, Turn::Counterclockwise);
}

template <class Archive>
void visit(Archive& archive, ProgramFrame& frame) {
  visit(archive, frame.back);
  visit_reading(archive, frame.reading);
  visit_all(archive, frame.label_base, frame.resumes_modal_call);
}
template <class Archive>
void visit(Archive& archive, LabelPlace& label) {
  visit_all(archive, label.program, label.label);
  visit(archive, label.at);
}

template <class Archive, class Element>
void visit_list(Archive& archive, std::vector<Element>& list, std::size_t most) {
  std::size_t count = list.size();
  if (!archive.size(count, most)) return;
  list.resize(count);
  for (Element& element : list) visit(archive, element);
}

template <class Archive>
void visit_transformation(Archive& archive, Transformation& transformation) {
  for (double& value : transformation.datum) visit(archive, value);
  visit(archive, transformation.basic_rotation);
  up_to(archive, transformation.basic_plane, Plane::YZ);
  for (double& value : transformation.shift) visit(archive, value);
  visit_values(archive, transformation.mirrored);
  visit(archive, transformation.rotation);
  up_to(archive, transformation.rotation_plane, Plane::YZ);
  visit(archive, transformation.scale);
  visit_values(archive, transformation.scaled);
}

template <class Archive>
void visit_contour(Archive& archive, State& state) {
  up_to(archive, state.compensation, Compensation::Shorter);
  visit_all(archive, state.uses_stages, state.joins, state.is_parallel, state.needs_side,
            state.has_compensated, state.is_first_contour, state.awaits_contour);
  Blend& blend = state.blend;
  up_to(archive, blend.kind, BlendKind::TangentialDeparture);
  visit_all(archive, blend.is_stated, blend.is_lost);
  visit(archive, blend.size);
  visit(archive, blend.origin);
  LastMove& last = state.last;
  visit_all(archive, last.exists, last.is_arc, last.has_both, last.has_third, last.is_single_offset,
            last.starts_contour);
  visit(archive, last.from);
  visit(archive, last.to);
  visit(archive, last.center);
  up_to(archive, last.turn, Turn::Counterclockwise);
  visit_values(archive, state.pole);
  visit_all(archive, state.has_pole, state.polar.exists, state.polar.is_current);
  visit(archive, state.polar.radius);
  visit(archive, state.polar.angle);
}

template <class Archive>
void visit_machine(Archive& archive, State& state) {
  visit(archive, state.machine);
  for (double& value : state.nominal) visit(archive, value);
  visit_transformation(archive, state.transformation);
  up_to(archive, state.plane, Plane::YZ);
  visit_all(archive, state.tool.number, state.tool.is_called);
  up_to(archive, state.tool.axis, Axis::W);
  visit(archive, state.tool.data.length);
  visit(archive, state.tool.data.radius);
  visit_list(archive, state.definitions, kLastTool);
  visit_list(archive, state.pockets, kMaxStoredTools);
  up_to(archive, state.spindle.state, SpindleState::Oriented);
  visit(archive, state.spindle.speed);
  visit_all(archive, state.spindle.has_speed, state.coolant.flood);
  visit(archive, state.feed);
  visit(archive, state.rotary_feed);
}

template <class Archive, std::size_t kCount>
void visit_bits(Archive& archive, std::bitset<kCount>& bits) {
  for (std::size_t i = 0; i < kCount; ++i) {
    bool bit = bits.test(i);
    archive(bit);
    bits.set(i, bit);
  }
}

template <class Archive>
void visit_start(Archive& archive, StartState& start) {
  visit_all(archive, start.is_searching, start.block, start.has_changed_tool, start.is_in_contour,
            start.contour_block);
  visit(archive, start.actual);
  visit(archive, start.expected);
  visit_bits(archive, start.codes);
  visit_bits(archive, start.assigned);
  visit_bits(archive, start.carried);
}

template <class Archive>
void visit_flow(Archive& archive, State& state) {
  visit_list(archive, state.labels, kMaxLabelLevels);
  visit_list(archive, state.programs, kMaxProgramLevels);
  visit_list(archive, state.known_labels, kMaxLabels);
  Jump& jump = state.jump;
  up_to(archive, jump.kind, JumpKind::CycleProgram);
  visit_all(archive, jump.number, jump.repeats);
  visit(archive, jump.call);
  visit_start(archive, state.start);
  visit_all(archive, state.is_restart, state.has_positioned);
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  up_to(archive, state.phase, RunPhase::Alarmed);
  visit_all(archive, state.has_header, state.are_calls_checked, state.blocks, state.number_due,
            state.program_number);
  visit(archive, state.at);
  visit_reading(archive, state.reading);
  up_to(archive, state.units, Units::Millimetre);
  visit_machine(archive, state);
  visit_contour(archive, state);
  for (double& value : state.q) visit(archive, value);
  visit_cycle_state(archive, state.cycle);
  BlankState& blank = state.blank;
  visit_all(archive, blank.has_minimum, blank.is_tool_across);
  up_to(archive, blank.axis, Axis::W);
  for (double& value : blank.minimum) visit(archive, value);
  visit_flow(archive, state);
}

bool is_plausible(const State& state) {
  const bool are_levels_right = std::all_of(
      state.programs.begin(), state.programs.end(),
      [&](const ProgramFrame& frame) { return frame.label_base <= state.labels.size(); });
  return are_levels_right && state.transformation.scale != 0;
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  StateWriter writer;
  State state = run.state;
  Origin origin = run.origin;
  visit_state(writer, state);
  visit(writer, origin);
  std::vector<std::byte> path;
  std::vector<std::byte> corner;
  if (state.uses_stages) path = run.compensator.state();
  if (state.joins) corner = run.blender.state();
  visit_bytes(writer, path, look_ahead::kMaxStateBytes);
  visit_bytes(writer, corner, look_ahead::kMaxStateBytes);
  return {std::string(kDialect), kSnapshotVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kSnapshotVersion); !kind) return kind;
  StateReader reader(snapshot.bytes);
  State state;
  Origin origin;
  std::vector<std::byte> path;
  std::vector<std::byte> corner;
  visit_state(reader, state);
  visit(reader, origin);
  visit_bytes(reader, path, look_ahead::kMaxStateBytes);
  visit_bytes(reader, corner, look_ahead::kMaxStateBytes);
  if (!reader.is_complete() || !is_plausible(state)) return snapshot.damage();
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
  run.limits.place(state.uses_stages ? run.compensator.sent() : state.machine);
  run.limits.reset();
  run.state = std::move(state);
  run.origin = origin;
  return {};
}

}  // namespace dripline::interpreter::tnc155
