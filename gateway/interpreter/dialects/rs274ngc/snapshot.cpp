#include <algorithm>

#include "gateway/interpreter/dialects/rs274ngc/run.hpp"
#include "gateway/interpreter/stages/look_ahead/state_bytes.hpp"

namespace dripline::interpreter::rs274ngc {

// Not in the unnamed namespace, where the archives would not find them.

template <class Archive>
void visit(Archive& archive, State& state) {
  archive(state.phase, state.has_header, state.demarcation, state.blocks, state.at, state.sequence,
          state.units, state.position, state.is_displaced, state.machine, state.system_offset,
          state.g92, state.tool_length, state.rotation, state.system, state.feed, state.feed_units,
          state.has_lost_lead, state.modes, state.spindle, state.tool, state.overrides, state.flood,
          state.mist, state.cycle, state.compensation, state.spline_i, state.spline_j,
          state.follows_spline, state.nurbs, state.turning, state.frames, state.calls, state.labels,
          state.label_names, state.skip, state.passes, state.saved);
}

template <class Archive>
void visit(Archive& archive, HeldEvents& held) {
  archive(held.start(), held.events());
  // A few events of the last lines may come on top.
  if (held.size() > 16 * HeldEvents::kMax) archive.damage();
  if (archive.is_damaged() || held.empty()) return;
  // The first event is always a move, because corners are made with it.
  const HeldEvents::Event& first = held.events().front();
  const bool is_move = std::holds_alternative<Rapid>(first) ||
                       std::holds_alternative<Line>(first) || std::holds_alternative<Arc>(first);
  if (!is_move) archive.damage();
}

namespace {

constexpr std::string_view kDialect = "rs274ngc";
constexpr std::uint32_t kVersion = 9;

/// Only the rows that the program has written.
template <class Archive>
void visit_tools(Archive& archive, const std::vector<Tool>& from_setup, std::vector<Tool>& tools) {
  std::size_t written = 0;
  for (std::size_t i = 0; i < tools.size(); ++i) written += !(tools[i] == from_setup[i]);
  if (!archive.size(written, tools.size())) return;
  std::size_t at = 0;
  for (std::size_t i = 0; i < written; ++i, ++at) {
    if constexpr (!Archive::kReads) {
      while (tools[at] == from_setup[at]) ++at;
    }
    auto row = static_cast<std::uint32_t>(at);
    archive(row);
    if (row >= tools.size()) return archive.damage();
    archive(tools[row]);
  }
}

/// What makes the passes of a cycle end.
bool is_plausible(const TurningCycle& cycle) {
  if (cycle.code == 0) return true;
  return is_turning_cycle(cycle.code) && cycle.increment > 0 && cycle.retract >= 0 &&
         cycle.distance >= 0 && cycle.last_distance >= 0 && cycle.passes >= 1 &&
         cycle.passes <= kMaxFinishingPasses && cycle.moves.size() <= kMaxContourMoves;
}

/// Values that index tables, and labels that name a name, must be in range whatever the bytes say.
bool is_plausible(const State& state) {
  const auto knows = [&](Label label) {
    constexpr std::int64_t kFirstName = std::int64_t{1} << 40;
    return label.value < kFirstName + static_cast<std::int64_t>(state.label_names.size());
  };
  const auto fits = [](const std::string& name) { return name.size() <= kMaxNameLength; };
  if (state.frames.size() > kMaxBlocks || state.calls.size() > kMaxCalls ||
      state.labels.size() > kMaxLabels || state.label_names.size() > kMaxLabels ||
      state.nurbs.points.size() > kMaxControlPoints || !is_plausible(state.turning) ||
      !std::ranges::all_of(state.label_names, fits)) {
    return false;
  }
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
         state.demarcation <= Demarcation::None && state.modes.feed <= FeedMode::PerRevolution &&
         state.compensation.side <= Side::Right && state.compensation.orientation < 9 &&
         state.skip.until <= SkipFor::FanucFile && state.nurbs.order >= kLeastOrder &&
         state.nurbs.order <= kMaxOrder && state.system >= 1 && state.system <= kSystems;
}

template <class Archive>
void visit_all(Archive& archive, State& state, Parameters& parameters, NamedParameters& names,
               HeldEvents& held, Origin& origin, const std::vector<Tool>& from_setup,
               std::vector<Tool>& tools) {
  archive(state);
  visit_tools(archive, from_setup, tools);
  language::visit_sparse(archive, parameters.size(),
                         [&](std::size_t number) -> double& { return parameters[number]; });
  archive(names, held, origin);
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  language::StateWriter writer;
  State state = run.state;
  Parameters parameters = run.parameters;
  NamedParameters names = run.names;
  HeldEvents held = run.held;
  Origin origin = run.origin;
  std::vector<Tool> tools = run.tools;
  visit_all(writer, state, parameters, names, held, origin, run.setup_tools, tools);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return kind;
  language::StateReader reader(snapshot.bytes);
  State state;
  Parameters parameters{};
  NamedParameters names;
  HeldEvents held;
  Origin origin;
  std::vector<Tool> tools = run.setup_tools;
  visit_all(reader, state, parameters, names, held, origin, run.setup_tools, tools);
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
