#include "gateway/interpreter/dialects/prototrak/snapshot.hpp"

#include "gateway/interpreter/core/language/state_archive.hpp"

namespace dripline::interpreter::prototrak {

// Not in the unnamed namespace, where the archives would not find them.
template <class Archive>
void visit(Archive& archive, ProgramEvent& event) {
  archive(event.kind, event.is_metric, event.is_counterclockwise, event.is_connected, event.begin,
          event.end, event.center, event.radius, event.conrad, event.angle, event.diameter,
          event.finish_cut, event.feed, event.side, event.tool, event.holes, event.from_event,
          event.to_event, event.passes, event.has_diameter, event.has_tool, event.is_converted,
          event.offset, event.line, event.sequence);
}
template <class Archive>
void visit(Archive& archive, KeptState& state) {
  archive(state.phase);
  if (state.phase != 0) archive(state.program, state.execution, state.path);
}

namespace {

constexpr std::string_view kDialect = "prototrak-plus";
constexpr std::uint32_t kVersion = 3;

bool is_plausible(const ProgramEvent& event) {
  return event.kind <= EventKind::CircularFrame && event.side <= ToolSide::Left &&
         event.tool <= 99 && event.holes <= 999;
}

bool is_plausible(const KeptState& state) {
  if (state.program.events.size() > kMaxEvents || state.execution.frames.size() > kMaxNesting + 1) {
    return false;
  }
  const auto most = static_cast<std::uint16_t>(state.program.events.size());
  for (const ProgramEvent& event : state.program.events) {
    if (!is_plausible(event)) return false;
  }
  for (const Frame& frame : state.execution.frames) {
    const bool is_range = frame.first >= 1 && frame.first <= frame.index &&
                          frame.index <= frame.last && frame.last <= most;
    if (!is_range || frame.pass < 1 || frame.pass > frame.passes || frame.passes > 99) return false;
  }
  const bool has_previous =
      !state.execution.frames.empty() &&
      state.execution.frames.back().index > state.execution.frames.back().first;
  if (state.execution.is_in_chain && !has_previous) return false;
  return state.phase <= 3 && (state.phase != 1 || !state.execution.frames.empty());
}

}  // namespace

Snapshot take_snapshot(KeptState state) {
  language::StateWriter writer;
  writer(state);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<KeptState> read_snapshot(const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return fail(kind.error());
  language::StateReader reader(snapshot.bytes, language::Numbers::Finite);
  KeptState state;
  reader(state);
  if (!reader.is_complete() || !is_plausible(state)) return snapshot.damage();
  return state;
}

}  // namespace dripline::interpreter::prototrak
