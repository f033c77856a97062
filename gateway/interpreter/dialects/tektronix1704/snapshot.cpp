#include "gateway/interpreter/core/language/state_archive.hpp"
#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

// Not in the unnamed namespace, where the archives would not find them.
template <class Archive>
void visit(Archive& archive, BlockInProgress& block) {
  archive(block.words, block.in_comment, block.is_begun, block.has_word, block.has_sign,
          block.is_negative, block.has_digit, block.has_tab, block.tab_is_told, block.address,
          block.value, block.digits, block.characters, block.faults, block.is_bad);
}
template <class Archive>
void visit(Archive& archive, State& state) {
  archive(state.phase, state.reader, state.has_header, state.blocks, state.mdi_done, state.place,
          state.part, state.wanted, state.head, state.has_block, state.is_rewound,
          state.is_tape_over, state.reads_on, state.motion, state.cycle, state.is_incremental,
          state.drills, state.program, state.origin, state.center, state.is_center_old,
          state.has_moved, state.plane, state.feed, state.spindle_code, state.tool_code,
          state.has_clearance, state.has_depth, state.clearance, state.depth, state.spindle,
          state.flood, state.mist, state.last, state.block);
}

namespace {

constexpr std::string_view kDialect = "tektronix-1704";
constexpr std::uint32_t kVersion = 5;

bool is_plausible(const State& state) {
  const auto is_code = [](std::int32_t code) { return code >= 0 && code <= 99; };
  return state.phase <= RunPhase::Alarmed && state.reader <= ReaderState::Search &&
         state.motion <= Motion::Cycle &&
         (state.cycle == 0 || (state.cycle >= 80 && state.cycle <= 89)) &&
         (state.motion != Motion::Cycle || state.cycle != 0) && is_code(state.spindle_code) &&
         is_code(state.tool_code) &&
         static_cast<std::size_t>(state.block.address) < kAddressCount && state.place.line >= 1 &&
         state.part >= 1 && state.wanted >= 1;
}

}  // namespace

Snapshot take_snapshot(const Run& run) {
  language::StateWriter writer;
  State state = run.state;
  Position position = run.position;
  Origin origin = run.origin;
  writer(state, position, origin);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<void> restore_snapshot(Run& run, const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return kind;
  language::StateReader reader(snapshot.bytes);
  State state;
  Position position;
  Origin origin;
  reader(state, position, origin);
  if (!reader.is_complete() || !is_plausible(state) || state.mdi_done > run.options.mdi.size() ||
      (state.reader == ReaderState::Search && !run.options.search))
    return snapshot.damage();
  run.state = state;
  run.position = position;
  run.origin = origin;
  return {};
}

}  // namespace dripline::interpreter::tektronix1704
