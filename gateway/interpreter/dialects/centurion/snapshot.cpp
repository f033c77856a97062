#include "gateway/interpreter/dialects/centurion/snapshot.hpp"

#include "gateway/interpreter/core/language/event_archive.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::string_view kDialect = "centurion";
constexpr std::size_t kMaxName = kMaxBlockBytes;

using Writer = language::StateWriter;
using Reader = language::StateReader;

template <class Archive, class... Values>
void all(Archive& archive, Values&... values) {
  language::visit_all(archive, values...);
}

template <class Archive>
void visit(Archive& archive, Point& point) {
  all(archive, point.x, point.z);
}
template <class Archive>
void visit(Archive& archive, TextPosition& at) {
  all(archive, at.program, at.after_cr, at.code_seen, at.segment_offset, at.segment_line, at.offset,
      at.line);
}
template <class Archive>
void visit(Archive& archive, CallFrame& frame) {
  visit(archive, frame.back);
  visit(archive, frame.entry);
  visit(archive, frame.floating_zero);
  all(archive, frame.passes_left, frame.gosub_base, frame.loop_base, frame.custom,
      frame.changes_tool);
}
template <class Archive>
void visit(Archive& archive, GosubFrame& frame) {
  visit(archive, frame.back);
  visit(archive, frame.entry);
  visit(archive, frame.floating_zero);
  all(archive, frame.passes_left, frame.loop_base);
}
template <class Archive>
void visit(Archive& archive, LoopFrame& frame) {
  visit(archive, frame.head);
  visit(archive, frame.next);
  archive(frame.wend_offset);
}

template <class Archive>
void visit(Archive& archive, PatternMove& move) {
  all(archive, move.kind, move.is_clockwise, move.is_feed_per_revolution);
  visit(archive, move.to);
  visit(archive, move.center);
  all(archive, move.sweep, move.feed, move.spindle, move.revolutions, move.surface, move.max_revolutions,
      move.line, move.sequence);
  if (move.kind > PatternMove::Kind::Spindle) archive.damage();
}

template <class Archive>
void visit(Archive& archive, PatternCycle& cycle) {
  archive(cycle.phase);
  if (cycle.phase > PatternPhase::Repeats) return archive.damage();
  if (cycle.phase == PatternPhase::None) return;
  all(archive, cycle.fault, cycle.code, cycle.last_label, cycle.program, cycle.end_offset,
      cycle.calls);
  visit(archive, cycle.back);
  visit(archive, cycle.origin);
  for (PlanePoint* point : {&cycle.home, &cycle.start, &cycle.finish, &cycle.rough, &cycle.tool}) {
    visit(archive, *point);
  }
  double feed = cycle.feed.length().mm();
  bool is_per_revolution = cycle.feed.per() == Feed::Per::Revolution;
  all(archive, cycle.step, cycle.relief, cycle.first_level, cycle.has_first_level,
      cycle.relief_is_45, cycle.passes, feed, is_per_revolution, cycle.done);
  cycle.feed = is_per_revolution ? Feed::per_revolution(Length::mm(feed))
                                 : Feed::per_minute(Length::mm(feed));
  std::size_t count = cycle.moves.size();
  if (!archive.size(count, kMaxPatternMoves)) return;
  cycle.moves.resize(count);
  for (PatternMove& move : cycle.moves) visit(archive, move);
}

template <class Archive>
void visit_files(Archive& archive, std::vector<ParameterFile>& files) {
  std::size_t count = files.size();
  if (!archive.size(count, kMaxParameterFiles)) return;
  files.resize(count);
  for (ParameterFile& file : files) {
    archive(file.number);
    std::size_t length = file.values.size();
    if (!archive.size(length, kUserParameters)) return;
    file.values.resize(length);
    for (double& value : file.values) archive(value);
  }
}

template <class Archive>
void visit_data_changes(Archive& archive, std::vector<DataChange>& changes) {
  std::size_t count = changes.size();
  if (!archive.size(count, kParameterCount - kFirstDataParameter)) return;
  changes.resize(count);
  for (DataChange& change : changes) {
    all(archive, change.number, change.value);
    if (change.number >= kParameterCount) return archive.damage();
  }
}

template <class Archive, class Frame>
void visit_stack(Archive& archive, std::vector<Frame>& stack) {
  std::size_t count = stack.size();
  if (!archive.size(count, kMaxNesting)) return;
  stack.resize(count);
  for (Frame& frame : stack) visit(archive, frame);
}

template <class Archive>
void visit_modes(Archive& archive, ModalState& state) {
  Modes& modes = state.modes;
  all(archive, modes.motion, modes.is_incremental, modes.is_feed_per_revolution,
      modes.is_surface_speed, modes.returns_to_clearance, modes.takes_data, modes.work_system,
      modes.compensation, state.nose.code, state.nose.radius_mm, state.nose.tip,
      state.nose.is_mirrored, state.nose_is_stale, state.uses_compensator, modes.path,
      modes.checks_zone, state.tool.has_no_length);
  Transformation& how = state.transformation;
  all(archive, how.mirrors_x, how.mirrors_z, how.scales, how.rotates, how.degrees);
  for (Point* point : {&how.mirror, &how.scale_center, &how.factor, &how.rotation_center,
                       &state.reference_via.at}) {
    visit(archive, *point);
  }
  all(archive, state.reference_via.x, state.reference_via.z);
  RetainedWords& retained = state.retained;
  all(archive, retained.radius, retained.start_angle, retained.end_angle, retained.center_x,
      retained.center_z, retained.has_radius, retained.arc_has_radius);
  SpindleModes& spindle = state.spindle;
  all(archive, spindle.state, spindle.revolutions, spindle.surface, spindle.limit);
  all(archive, state.coolant.flood, state.coolant.mist, state.wants_flood, state.outputs,
      state.is_searching, state.searched_axes);
  visit(archive, state.searched_from);
  visit(archive, state.searched_to);
  visit(archive, state.coolant.origin);
  ToolModes& tool = state.tool;
  all(archive, tool.pending, tool.pending_offset, tool.active, tool.offset);
}

template <class Archive>
void visit_state(Archive& archive, ModalState& state) {
  all(archive, state.phase, state.has_header, state.moved_axes, state.units, state.blocks);
  visit(archive, state.at);
  for (Point* point : {&state.position, &state.previous, &state.origin, &state.floating_zero,
                       &state.local_zero, &state.last_arc_center}) {
    visit(archive, *point);
  }
  all(archive, state.last_arc_radius, state.dwell_seconds, state.feed[0], state.feed[1],
      state.random);
  visit_modes(archive, state);
  bool is_open = state.open_device.has_value();
  auto device = state.open_device.value_or(OutputDevice::File);
  all(archive, is_open, device);
  state.open_device = is_open ? std::optional<OutputDevice>(device) : std::nullopt;
  visit_stack(archive, state.calls);
  visit_stack(archive, state.gosubs);
  visit_stack(archive, state.loops);
  visit_files(archive, state.files);
  visit_data_changes(archive, state.data_changes);
  Jump& jump = state.jump;
  all(archive, jump.kind, jump.is_call_word, jump.condition, jump.number, jump.passes, jump.custom,
      jump.changes_tool, jump.is_not_in_ram);
  visit(archive, jump.from);
  visit(archive, state.pattern);
}

/// The state, and while a pattern is read the one before it.
template <class Archive>
void visit_states(Archive& archive, ModalState& state) {
  visit_state(archive, state);
  std::size_t count = state.before_pattern.size();
  if (!archive.size(count, 1)) return;
  state.before_pattern.resize(count);
  for (ModalState& before : state.before_pattern) visit_state(archive, before);
}

/// Only the values that are not 0: most are.
template <class Archive, class Value>
void visit_sparse(Archive& archive, int count, Value value_at) {
  std::size_t used = 0;
  for (int number = 0; number < count; ++number) used += value_at(number) != 0;
  if (!archive.size(used, static_cast<std::size_t>(count))) return;
  if constexpr (std::is_same_v<Archive, Writer>) {
    for (int number = 0; number < count; ++number) {
      if (value_at(number) != 0) all(archive, number, value_at(number));
    }
  } else {
    for (std::size_t i = 0; i < used; ++i) {
      int number = 0;
      archive(number);
      if (number < 0 || number >= count) archive.damage();
      if (archive.is_damaged()) return;
      archive(value_at(number));
    }
  }
}

template <class Archive>
void visit_parameters(Archive& archive, Parameters& parameters) {
  visit_sparse(archive, kParameterCount, [&](int n) -> double& { return parameters[n]; });
  visit_sparse(archive, kByteCount, [&](int n) -> std::uint8_t& { return parameters.byte(n); });
}

/// Only while a start is looked for: they are not read afterwards.
template <class Archive>
void visit_notes(Archive& archive, StartNotes& notes) {
  std::size_t cells = notes.uses.size();
  if (!archive.size(cells, kParameterCount + kByteCount)) return;
  if (cells != 0 && cells != kParameterCount + kByteCount) return archive.damage();
  notes.uses.resize(cells);
  for (StartNotes::Use& use : notes.uses) {
    archive(use);
    if (use > StartNotes::Use::Lost) return archive.damage();
  }
  all(archive, notes.has_place, notes.program, notes.offset, notes.arrivals, notes.arrival);
  std::size_t withheld = notes.withheld.size();
  if (!archive.size(withheld, StartNotes::kMaxWithheld)) return;
  notes.withheld.resize(withheld);
  for (auto& [code, state, line] : notes.withheld) all(archive, code, state, line);
}

template <class Archive>
void visit_name(Archive& archive, std::string& name, bool& is_settled) {
  std::size_t length = name.size();
  if (!archive.size(length, kMaxName)) return;
  name.resize(length);
  for (char& c : name) archive(c);
  archive(is_settled);
}

/// A cycle that cuts has moves.
bool is_plausible(const PatternCycle& cycle, std::size_t states_before) {
  const bool is_reading = cycle.phase == PatternPhase::Reading;
  const bool cuts = cycle.phase >= PatternPhase::Levels;
  return is_reading == (states_before == 1) && (!cuts || (!cycle.moves.empty() && cycle.step >= 0));
}

/// Values that index tables must be in range, whatever the bytes say.
bool is_plausible(const ModalState& state) {
  return state.phase <= RunPhase::Alarmed && state.units <= Units::Millimetre &&
         state.modes.motion <= MotionMode::Counterclockwise && state.modes.work_system < 6 &&
         state.modes.compensation <= 2 && state.nose.code <= 2 &&
         state.spindle.state <= SpindleState::Oriented && state.tool.offset >= 0 &&
         state.tool.offset <= kOffsetCount && state.jump.kind <= JumpKind::Pattern &&
         is_plausible(state.pattern, state.before_pattern.size()) &&
         state.open_device.value_or(OutputDevice::File) <= OutputDevice::Printer;
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  Writer writer;
  ModalState state = run.state;
  std::vector<std::byte> joins = run.blender.state();
  std::vector<std::byte> path;
  if (state.uses_compensator) path = run.compensator.state();
  Parameters parameters = run.parameters;
  Origin origin = run.origin;
  std::string name = run.name;
  bool is_settled = run.is_name_final;
  visit_states(writer, state);
  StartNotes notes = run.start;
  if (state.is_searching) visit_notes(writer, notes);
  visit_parameters(writer, parameters);
  visit(writer, origin);
  visit_name(writer, name, is_settled);
  language::visit_bytes(writer, joins, look_ahead::kMaxStateBytes);
  language::visit_bytes(writer, path, look_ahead::kMaxStateBytes);
  return {std::string(kDialect), kSnapshotVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kSnapshotVersion); !kind) return kind;
  Reader reader(snapshot.bytes);
  ModalState state;
  Parameters parameters;
  Origin origin;
  std::string name;
  bool is_settled = false;
  visit_states(reader, state);
  StartNotes notes;
  if (state.is_searching) visit_notes(reader, notes);
  visit_parameters(reader, parameters);
  visit(reader, origin);
  visit_name(reader, name, is_settled);
  std::vector<std::byte> joins, path;
  language::visit_bytes(reader, joins, look_ahead::kMaxStateBytes);
  language::visit_bytes(reader, path, look_ahead::kMaxStateBytes);
  if (!reader.is_complete() || !is_plausible(state)) return snapshot.damage();
  if (auto restored = run.blender.restore(joins); !restored) return restored;
  if (!state.uses_compensator) {
    run.compensator.reset({});
  } else if (auto restored = run.compensator.restore(path); !restored) {
    return restored;
  }
  run.state = std::move(state);
  run.parameters = parameters;
  run.start = std::move(notes);
  run.origin = origin;
  run.name = std::move(name);
  run.is_name_final = is_settled;
  run.front = nullptr;
  if (run.state.has_header) run.connect_stages();
  return {};
}

}  // namespace dripline::interpreter::centurion
