#include <algorithm>

#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {

// Not in the unnamed namespace, where the archives would not find them.

template <class Archive>
void visit(Archive& archive, PatternCycle& cycle) {
  archive(cycle.phase);
  if (cycle.phase > PatternPhase::Repeats) return archive.damage();
  if (cycle.phase == PatternPhase::None) return;
  archive(cycle.fault, cycle.code, cycle.last_label, cycle.program, cycle.end_offset, cycle.calls,
          cycle.back, cycle.origin, cycle.home, cycle.start, cycle.finish, cycle.rough, cycle.tool,
          cycle.step, cycle.relief, cycle.first_level, cycle.has_first_level, cycle.relief_is_45,
          cycle.passes, cycle.feed, cycle.done, cycle.moves);
}

template <class Archive>
void visit(Archive& archive, ModalState& state) {
  archive(state.phase, state.has_header, state.moved_axes, state.units, state.blocks, state.at,
          state.position, state.previous, state.length_taken, state.previous_machine, state.origin,
          state.floating_zero, state.local_zero, state.transformation, state.reference_via,
          state.last_arc_center, state.last_arc_radius, state.dwell_seconds, state.feed,
          state.modes, state.retained, state.spindle, state.coolant, state.tool, state.nose,
          state.nose_is_stale, state.uses_compensator, state.is_searching, state.searched_from,
          state.searched_to, state.searched_axes, state.wants_flood, state.outputs,
          state.open_device, state.random, state.calls, state.gosubs, state.loops, state.files,
          state.data_changes, state.jump, state.pattern, state.before_pattern,
          state.cycle_feed_code);
}

namespace {

constexpr std::string_view kDialect = "centurion";
constexpr std::uint32_t kVersion = 8;

template <class Archive>
void visit_parameters(Archive& archive, Parameters& parameters) {
  language::visit_sparse(archive, kParameterCount, [&](std::size_t number) -> double& {
    return parameters[static_cast<int>(number)];
  });
  language::visit_sparse(archive, kByteCount, [&](std::size_t number) -> std::uint8_t& {
    return parameters.byte(static_cast<int>(number));
  });
}

/// Of all cells or none, while a start is looked for.
bool is_plausible(const StartNotes& notes) {
  const std::size_t cells = notes.uses.size();
  return (cells == 0 || cells == kParameterCount + kByteCount) &&
         notes.withheld.size() <= StartNotes::kMaxWithheld &&
         std::ranges::all_of(notes.uses, [](auto use) { return use <= StartNotes::Use::Lost; });
}

/// A cycle that cuts has moves.
bool is_plausible(const PatternCycle& cycle, std::size_t states_before) {
  if (cycle.moves.size() > kMaxPatternMoves || states_before > 1) return false;
  for (const PatternMove& move : cycle.moves) {
    if (move.kind > PatternMove::Kind::Spindle) return false;
  }
  const bool is_reading = cycle.phase == PatternPhase::Reading;
  const bool cuts = cycle.phase >= PatternPhase::Levels;
  return is_reading == (states_before == 1) && (!cuts || (!cycle.moves.empty() && cycle.step >= 0));
}

bool has_plausible_lists(const ModalState& state) {
  const auto fits = [](const ParameterFile& file) { return file.values.size() <= kUserParameters; };
  const auto exists = [](const DataChange& change) { return change.number < kParameterCount; };
  return state.calls.size() <= kMaxNesting && state.gosubs.size() <= kMaxNesting &&
         state.loops.size() <= kMaxNesting && state.files.size() <= kMaxParameterFiles &&
         std::ranges::all_of(state.files, fits) &&
         state.data_changes.size() <= kParameterCount - kFirstDataParameter &&
         std::ranges::all_of(state.data_changes, exists);
}

/// Values that index tables must be in range, whatever the bytes say.
bool is_plausible(const ModalState& state) {
  return has_plausible_lists(state) && state.phase <= RunPhase::Alarmed &&
         state.modes.motion <= MotionMode::Counterclockwise && state.modes.work_system < 6 &&
         state.modes.compensation <= 2 && state.nose.code <= 2 && state.tool.offset >= 0 &&
         state.tool.offset <= kOffsetCount && state.jump.kind <= JumpKind::Pattern &&
         is_plausible(state.pattern, state.before_pattern.size()) &&
         std::ranges::all_of(state.before_pattern, has_plausible_lists);
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  language::StateWriter writer;
  ModalState state = run.state;
  StartNotes notes = state.is_searching ? run.start : StartNotes{};
  Parameters parameters = run.parameters;
  Origin origin = run.origin;
  std::string name = run.name;
  bool is_name_final = run.is_name_final;
  std::vector<std::byte> blends = run.blender.state();
  std::vector<std::byte> path;
  if (state.uses_compensator) path = run.compensator.state();
  writer(state, notes);
  visit_parameters(writer, parameters);
  writer(origin, name, is_name_final, blends, path);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return kind;
  language::StateReader reader(snapshot.bytes);
  ModalState state;
  StartNotes notes;
  Parameters parameters;
  Origin origin;
  std::string name;
  bool is_name_final = false;
  std::vector<std::byte> blends, path;
  reader(state, notes);
  visit_parameters(reader, parameters);
  reader(origin, name, is_name_final, blends, path);
  if (!reader.is_complete() || !is_plausible(state) || !is_plausible(notes)) {
    return snapshot.damage();
  }
  const std::vector<std::byte> blends_before = run.blender.state();
  if (auto restored = run.blender.restore(blends); !restored) return restored;
  if (!state.uses_compensator) {
    run.compensator.reset({});
  } else if (auto restored = run.compensator.restore(path); !restored) {
    (void)run.blender.restore(blends_before);  // a snapshot is taken as a whole or not at all
    return restored;
  }
  run.state = std::move(state);
  run.parameters = parameters;
  run.start = std::move(notes);
  run.origin = origin;
  run.name = std::move(name);
  run.is_name_final = is_name_final;
  run.front = nullptr;
  if (run.state.has_header) run.connect_stages();
  return {};
}

}  // namespace dripline::interpreter::centurion
