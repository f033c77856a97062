#include "gateway/interpreter/dialects/rs274ngc/snapshot.hpp"

#include "gateway/interpreter/stages/look_ahead/state_bytes.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

using language::StateReader;
using language::StateWriter;
using language::visit;
using language::visit_all;
using language::visit_text;
using look_ahead::visit;

constexpr std::string_view kDialect = "rs274ngc";

template <class Archive>
void visit(Archive& archive, Modes& modes) {
  visit_all(archive, modes.motion, modes.plane, modes.has_tilted_plane, modes.is_incremental,
            modes.is_arc_absolute, modes.retracts_to_start, modes.is_diameter, modes.feed,
            modes.path, modes.path_tolerance, modes.cam_tolerance);
}

template <class Archive>
void visit(Archive& archive, SpindleModes& spindle) {
  visit_all(archive, spindle.state, spindle.speed, spindle.is_surface, spindle.most);
}

template <class Archive>
void visit(Archive& archive, Overrides& overrides) {
  visit_all(archive, overrides.speed, overrides.feed, overrides.adaptive, overrides.hold);
}

template <class Archive>
void visit(Archive& archive, SavedModes& saved) {
  visit_all(archive, saved.is_valid, saved.restores_at_return);
  visit(archive, saved.modes);
  visit_all(archive, saved.units, saved.system, saved.feed);
  visit(archive, saved.spindle);
  visit_all(archive, saved.flood, saved.mist);
  visit(archive, saved.overrides);
}

template <class Archive>
void visit(Archive& archive, BlockFrame& frame) {
  visit_all(archive, frame.kind, frame.label.value);
  visit(archive, frame.head);
  archive(frame.left);
}

template <class Archive>
void visit(Archive& archive, CallFrame& frame) {
  archive(frame.scope.value);
  visit(archive, frame.back);
  visit(archive, frame.entry);
  visit_all(archive, frame.is_fanuc, frame.passes_left, frame.block_base);
  for (double& value : frame.saved) archive(value);
  visit(archive, frame.modes);
}

template <class Archive>
void visit(Archive& archive, KnownLabel& known) {
  visit_all(archive, known.scope.value, known.label.value, known.is_subprogram);
  visit(archive, known.place);
}

template <class Archive>
void visit(Archive& archive, ControlPoint& point) {
  visit_all(archive, point.x, point.y, point.weight);
}

template <class Archive, class Element>
void visit_list(Archive& archive, std::vector<Element>& list, std::size_t most) {
  std::size_t count = list.size();
  if (!archive.size(count, most)) return;
  list.resize(count);
  for (Element& element : list) visit(archive, element);
}

template <class Archive>
void visit_axes(Archive& archive, Axes& axes) {
  for (double& value : axes) archive(value);
}

template <class Archive>
void visit_coordinates(Archive& archive, State& state) {
  visit_all(archive, state.units, state.is_displaced);
  visit_axes(archive, state.position);
  visit(archive, state.machine);
  visit_axes(archive, state.system_offset);
  visit_axes(archive, state.g92);
  visit_axes(archive, state.tool_length);
  visit_all(archive, state.rotation, state.system);
}

template <class Archive>
void visit_modal(Archive& archive, State& state) {
  archive(state.feed);
  visit(archive, state.modes);
  visit(archive, state.spindle);
  visit_all(archive, state.tool.selected, state.tool.loaded);
  visit(archive, state.overrides);
  CycleWords& cycle = state.cycle;
  visit_all(archive, state.flood, state.mist, cycle.r, cycle.bottom, cycle.p, cycle.q, cycle.i,
            cycle.j, cycle.k, cycle.d, cycle.is_series, cycle.initial);
  Compensation& compensation = state.compensation;
  visit_all(archive, compensation.side, compensation.radius, compensation.is_first,
            compensation.was_on, compensation.x, compensation.y, compensation.left[0],
            compensation.left[1], compensation.left[2], compensation.held_sweep,
            compensation.orientation);
  visit_all(archive, state.spline_i, state.spline_j, state.follows_spline);
}

template <class Archive>
void visit(Archive& archive, Nurbs& nurbs) {
  archive(nurbs.order);
  visit_list(archive, nurbs.points, kMaxControlPoints);
}

template <class Archive>
void visit_flow(Archive& archive, State& state) {
  visit_list(archive, state.frames, kMaxBlocks);
  visit_list(archive, state.calls, kMaxCalls);
  visit_list(archive, state.labels, kMaxLabels);
  std::size_t count = state.label_names.size();
  if (!archive.size(count, kMaxLabels)) return;
  state.label_names.resize(count);
  for (std::string& name : state.label_names) visit_text(archive, name, kMaxNameLength);
  visit_all(archive, state.skip.until, state.skip.label.value);
  visit(archive, state.skip.from);
  archive(state.passes);
  visit(archive, state.saved);
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  visit_all(archive, state.phase, state.has_header, state.demarcation, state.blocks);
  visit(archive, state.at);
  visit_coordinates(archive, state);
  visit_modal(archive, state);
  visit(archive, state.nurbs);
  visit_flow(archive, state);
}

/// Only the values that are not 0: most are.
template <class Archive>
void visit_parameters(Archive& archive, Parameters& parameters) {
  std::size_t used = 0;
  for (const double value : parameters) used += value != 0;
  if (!archive.size(used, parameters.size())) return;
  std::size_t at = 0;
  for (std::size_t i = 0; i < used; ++i) {
    if constexpr (!Archive::kReads) {
      while (parameters[at] == 0) ++at;
    }
    auto number = static_cast<std::uint32_t>(at);
    archive(number);
    if (number >= parameters.size()) return archive.damage();
    archive(parameters[number]);
    ++at;
  }
}

/// Only the rows that the program has written.
template <class Archive>
void visit_tools(Archive& archive, const std::vector<Tool>& from_setup, std::vector<Tool>& tools) {
  std::size_t written = 0;
  for (std::size_t i = 0; i < tools.size(); ++i) written += !(tools[i] == from_setup[i]);
  if (!archive.size(written, tools.size())) return;
  std::size_t at = 0;
  for (std::size_t i = 0; i < written; ++i) {
    if constexpr (!Archive::kReads) {
      while (tools[at] == from_setup[at]) ++at;
    }
    auto row = static_cast<std::uint32_t>(at);
    archive(row);
    if (row >= tools.size()) return archive.damage();
    Tool& tool = tools[row];
    visit_axes(archive, tool.length);
    visit_all(archive, tool.diameter, tool.front_angle, tool.back_angle, tool.orientation);
    ++at;
  }
}

template <class Archive>
void visit(Archive& archive, HeldEvents::Text& event) {
  visit(archive, event.head);
  visit_text(archive, event.text, look_ahead::kMaxHeldText);
}

template <std::size_t kIndex = 0>
bool make_event(std::size_t index, HeldEvents::Event& event) {
  if constexpr (kIndex < std::variant_size_v<HeldEvents::Event>) {
    if (index != kIndex) return make_event<kIndex + 1>(index, event);
    event.emplace<kIndex>();
    return true;
  }
  return false;
}

template <class Archive>
void visit_held(Archive& archive, HeldEvents& held) {
  std::size_t count = held.size();
  // A few events of the last lines may come on top.
  if (!archive.size(count, 16 * HeldEvents::kMax)) return;
  visit(archive, held.start());
  if constexpr (Archive::kReads) held.events().resize(count);
  for (HeldEvents::Event& event : held.events()) {
    auto index = static_cast<std::uint8_t>(event.index());
    archive(index);
    if (Archive::kReads && !make_event(index, event)) return archive.damage();
    std::visit([&](auto& each) { visit(archive, each); }, event);
  }
  if constexpr (Archive::kReads) {
    if (archive.is_damaged() || held.empty()) return;
    // The first event is always a move, because corners are made with it.
    const HeldEvents::Event& first = held.events().front();
    const bool is_move = std::holds_alternative<Rapid>(first) ||
                         std::holds_alternative<Line>(first) || std::holds_alternative<Arc>(first);
    if (!is_move) archive.damage();
  }
}

/// Values that index tables, and labels that name a name, must be in range whatever the bytes say.
bool is_plausible(const State& state) {
  const auto knows = [&](Label label) {
    constexpr std::int64_t kFirstName = std::int64_t{1} << 40;
    return label.value < kFirstName + static_cast<std::int64_t>(state.label_names.size());
  };
  for (const CallFrame& frame : state.calls) {
    if (!knows(frame.scope) || frame.block_base > state.frames.size()) return false;
  }
  for (const BlockFrame& frame : state.frames) {
    if (!knows(frame.label) || frame.kind > BlockKind::Repeat) return false;
  }
  for (const KnownLabel& known : state.labels) {
    if (!knows(known.label) || !knows(known.scope)) return false;
  }
  const bool knows_motion = g_row(state.modes.motion, Profile::LinuxCnc) != nullptr;
  return knows(state.skip.label) && knows_motion && state.phase <= RunPhase::Alarmed &&
         state.demarcation <= Demarcation::None && state.units <= Units::Millimetre &&
         state.modes.plane <= Plane::YZ && state.modes.feed <= FeedMode::PerRevolution &&
         state.compensation.side <= Side::Right && state.compensation.orientation < 9 &&
         state.skip.until <= SkipFor::FanucFile && state.nurbs.order >= kLeastOrder &&
         state.nurbs.order <= kMaxOrder && state.system >= 1 && state.system <= kSystems &&
         state.spindle.state <= SpindleState::Oriented;
}

template <class Archive>
void visit_all_of(Archive& archive, State& state, Parameters& parameters, NamedParameters& names,
                  HeldEvents& held, Origin& origin, const std::vector<Tool>& from_setup,
                  std::vector<Tool>& tools) {
  visit_state(archive, state);
  visit_tools(archive, from_setup, tools);
  visit_parameters(archive, parameters);
  names.visit(archive);
  visit_held(archive, held);
  visit(archive, origin);
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  StateWriter writer;
  State state = run.state;
  Parameters parameters = run.parameters;
  NamedParameters names = run.names;
  HeldEvents held = run.held;
  Origin origin = run.origin;
  std::vector<Tool> tools = run.tools;
  visit_all_of(writer, state, parameters, names, held, origin, run.setup_tools, tools);
  return {std::string(kDialect), kSnapshotVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kSnapshotVersion); !kind) return kind;
  StateReader reader(snapshot.bytes);
  State state;
  Parameters parameters{};
  NamedParameters names;
  HeldEvents held;
  Origin origin;
  std::vector<Tool> tools = run.setup_tools;
  visit_all_of(reader, state, parameters, names, held, origin, run.setup_tools, tools);
  if (!reader.is_complete() || !is_plausible(state)) return snapshot.damage();
  run.state = std::move(state);
  run.parameters = parameters;
  run.names = std::move(names);
  run.held = std::move(held);
  run.origin = origin;
  run.tools = std::move(tools);
  return {};
}

}  // namespace dripline::interpreter::rs274ngc
