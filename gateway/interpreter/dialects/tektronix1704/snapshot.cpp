#include "gateway/interpreter/dialects/tektronix1704/snapshot.hpp"

#include <algorithm>

#include "gateway/interpreter/core/language/event_archive.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

using language::StateReader;
using language::StateWriter;
using language::visit_all;

constexpr std::string_view kDialect = "tektronix-1704";
constexpr std::uint32_t kVersion = 2;

template <class Archive>
void visit(Archive& archive, BlockInProgress& block) {
  block.words.visit(archive);
  visit_all(archive, block.in_comment, block.is_begun, block.has_word, block.has_sign,
            block.is_negative, block.has_digit, block.has_tab, block.address, block.value,
            block.digits, block.characters, block.faults, block.is_bad);
}
template <class Archive>
void visit(Archive& archive, LastMove& last) {
  visit_all(archive, last.flows, last.direction[0], last.direction[1], last.direction[2],
            last.block, last.feed, last.length);
  visit(archive, last.origin);
}
template <class Archive>
void visit(Archive& archive, State& state, Position& position, Origin& origin) {
  visit_all(archive, state.phase, state.reader, state.has_header, state.blocks, state.mdi_done,
            state.place.program, state.place.offset, state.place.line, state.motion, state.cycle,
            state.is_incremental, state.drills);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    visit_all(archive, state.program[axis], state.origin[axis], state.center[axis]);
    const auto name = static_cast<Axis>(axis);
    double raw = position.raw(name);
    bool is_marked = position.has(name);
    visit_all(archive, raw, is_marked);
    position.set_raw(name, raw);
    if (!is_marked) position.unmark(name);
  }
  visit_all(archive, state.plane, state.feed, state.spindle_code, state.tool_code,
            state.has_clearance, state.has_depth, state.clearance, state.depth, state.spindle,
            state.flood, state.mist);
  visit(archive, state.last);
  visit(archive, state.block);
  visit(archive, origin);
}

bool is_plausible(const State& state) {
  const auto is_code = [](std::int32_t code) { return code >= 0 && code <= 99; };
  return state.phase <= RunPhase::Alarmed && state.reader <= ReaderState::Search &&
         state.motion <= Motion::Cycle &&
         (state.cycle == 0 || (state.cycle >= 80 && state.cycle <= 89)) &&
         (state.motion != Motion::Cycle || state.cycle != 0) && state.plane <= Plane::YZ &&
         state.spindle <= SpindleState::Oriented && is_code(state.spindle_code) &&
         is_code(state.tool_code) &&
         static_cast<std::size_t>(state.block.address) < kAddressCount && state.place.line >= 1;
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  StateWriter writer;
  State state = run.state;
  Position position = run.position;
  Origin origin = run.origin;
  visit(writer, state, position, origin);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return kind;
  StateReader reader(snapshot.bytes);
  State state;
  Position position;
  Origin origin;
  visit(reader, state, position, origin);
  if (!reader.is_complete() || !is_plausible(state) || state.mdi_done > run.options.mdi.size() ||
      (state.reader == ReaderState::Search && !run.options.search))
    return snapshot.damage();
  run.state = state;
  run.position = position;
  run.origin = origin;
  return {};
}

}  // namespace dripline::interpreter::tektronix1704
