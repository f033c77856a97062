#include "gateway/interpreter/dialects/prototrak/snapshot.hpp"

#include <cmath>

#include "gateway/interpreter/core/language/event_archive.hpp"

namespace dripline::interpreter::prototrak {
namespace {

using language::StateReader;
using language::StateWriter;
using language::visit_all;

constexpr std::string_view kDialect = "prototrak-plus";
constexpr std::uint32_t kVersion = 2;

template <class Archive>
void visit(Archive& archive, ProgramEvent& event) {
  visit_all(archive, event.kind, event.is_metric, event.is_counterclockwise, event.is_connected,
            event.begin.x, event.begin.y, event.end.x, event.end.y, event.center.x, event.center.y,
            event.radius, event.conrad, event.angle, event.diameter, event.finish_cut, event.feed,
            event.side, event.tool, event.holes, event.from_event, event.to_event, event.passes,
            event.has_diameter, event.has_tool, event.is_converted, event.offset, event.line,
            event.sequence);
}
template <class Archive>
void visit(Archive& archive, Frame& frame) {
  visit_all(archive, frame.first, frame.last, frame.index, frame.pass, frame.passes, frame.step.x,
            frame.step.y, frame.diameter, frame.tool, frame.has_diameter, frame.has_tool);
}
template <class Archive, class List>
void visit_list(Archive& archive, List& list, std::size_t most) {
  std::size_t count = list.size();
  if (!archive.size(count, most)) return;
  list.resize(count);
  for (auto& each : list) visit(archive, each);
}

template <class Archive>
void visit_kept(Archive& archive, KeptState& state) {
  archive(state.phase);
  if (state.phase == 0) return;
  visit_list(archive, state.program.events, kMaxEvents);
  visit_all(archive, state.program.part_number, state.program.has_part_number,
            state.program.is_metric);
  ExecutionState& execution = state.execution;
  visit_list(archive, execution.frames, kMaxNesting + 1);
  visit_all(archive, execution.blocks, execution.loaded_tool, execution.is_in_chain,
            execution.is_metric, execution.at.x, execution.at.y);
  language::visit_bytes(archive, state.path, look_ahead::kMaxStateBytes);
}

bool is_plausible(const ProgramEvent& event) {
  for (const double value :
       {event.begin.x, event.begin.y, event.end.x, event.end.y, event.center.x, event.center.y,
        event.radius, event.conrad, event.angle, event.diameter, event.finish_cut, event.feed}) {
    if (!std::isfinite(value)) return false;
  }
  return event.kind <= EventKind::CircularFrame && event.side <= ToolSide::Left &&
         event.tool <= 99 && event.holes <= 999;
}

bool is_plausible(const KeptState& state) {
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
  StateWriter writer;
  visit_kept(writer, state);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<KeptState> read_snapshot(const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return fail(kind.error());
  StateReader reader(snapshot.bytes);
  KeptState state;
  visit_kept(reader, state);
  if (!reader.is_complete() || !is_plausible(state)) return snapshot.damage();
  return state;
}

}  // namespace dripline::interpreter::prototrak
