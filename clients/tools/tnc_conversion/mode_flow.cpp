#include "clients/tools/tnc_conversion/mode_flow.hpp"

#include <bit>
#include <map>

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

bool is_label(const IsoBlock& block) {
  return block.has(IsoGroup::Label);
}
bool is_label_call(const IsoBlock& block) {
  return block.label != IsoBlock::kNone && !is_label(block);
}
bool is_end_of_run(const IsoBlock& block) {
  return block.m == 2 || block.m == 30;
}
/// The label a D09 to D12 jumps to, or kNone.
std::int32_t jump_target(const IsoBlock& block) {
  if (block.function < 9 || !block.has_parameter(3)) return IsoBlock::kNone;
  return block.cycle[3].value.number / Value::kStepsPerUnit;
}

/// The distance in force after a block, as its words are sorted; AsBefore: the block does not set
/// it.
Distance distance_after(const IsoBlock& block) {
  if (block.last_distance != Distance::AsBefore) return block.last_distance;
  Distance last = Distance::AsBefore;
  for (std::size_t i = 0; i < kIsoSlots; ++i) {
    const auto slot = static_cast<IsoSlot>(i);
    if (block.has(slot) && block.distance(slot) != Distance::AsBefore) last = block.distance(slot);
  }
  return last;
}

/// The plane of a blank or a rotation belongs to them.
bool sets_plane(const IsoBlock& block) {
  return block.has(IsoGroup::Plane) && !block.has(IsoGroup::Blank) &&
         !block.has_code(IsoGroup::Cycle, 73);
}

ModesBefore after(const IsoBlock& block, ModesBefore state) {
  if (block.has(IsoGroup::Motion) && block.code(IsoGroup::Motion) != 7) {
    state.modes.motion = block.code(IsoGroup::Motion);
    state.is_motion_open = false;
  }
  if (block.has(IsoGroup::Motion)) {
    const int motion = block.code(IsoGroup::Motion);
    const bool is_clockwise = motion == 2 || motion == 12;
    if (is_clockwise || motion == 3 || motion == 13) {
      state.modes.last_turn = is_clockwise ? Turn::Clockwise : Turn::Counterclockwise;
      state.is_turn_open = false;
    }
  }
  if (const Distance last = distance_after(block); last != Distance::AsBefore) {
    state.modes.has_distance = true;
    state.modes.is_incremental = last == Distance::Incremental;
    state.is_distance_open = false;
  }
  if (block.has(IsoGroup::Compensation)) {
    state.modes.has_compensation = true;
    state.is_compensation_open = false;
  }
  if (sets_plane(block)) {
    state.modes.has_plane = true;
    state.is_plane_open = false;
  }
  return state;
}

/// True when `into` changed.
bool merge(ModesBefore& into, const ModesBefore& from) {
  if (!into.is_reached) {
    into = from;
    into.is_reached = true;
    return true;
  }
  const ModesBefore old = into;
  into.is_motion_open |= from.is_motion_open || into.modes.motion != from.modes.motion;
  into.is_distance_open |= from.is_distance_open ||
                           into.modes.has_distance != from.modes.has_distance ||
                           into.modes.is_incremental != from.modes.is_incremental;
  into.is_turn_open |= from.is_turn_open || into.modes.last_turn != from.modes.last_turn;
  into.is_plane_open |= from.is_plane_open || into.modes.has_plane != from.modes.has_plane;
  into.is_compensation_open |=
      from.is_compensation_open || into.modes.has_compensation != from.modes.has_compensation;
  into.modes.has_plane |= from.modes.has_plane;
  into.modes.has_compensation |= from.modes.has_compensation;
  return into != old;
}

class ModeFlow {
 public:
  explicit ModeFlow(const IsoProgram& program) : blocks_(program.blocks), before_(blocks_.size()) {
    find_labels();
  }

  std::vector<ModesBefore> run() {
    for (std::size_t seed = 0; seed < blocks_.size(); ++seed) {
      if (before_[seed].is_reached) continue;
      reach(seed, seed == 0 ? ModesBefore{} : after(blocks_[seed - 1].block, before_[seed - 1]));
      while (!waiting_.empty()) {
        const std::size_t next = waiting_.back();
        waiting_.pop_back();
        pass_on(next);
      }
    }
    return std::move(before_);
  }

 private:
  void find_labels() {
    std::size_t end_of_sub = blocks_.size();
    for (std::size_t i = blocks_.size(); i-- > 0;) {
      const IsoBlock& block = blocks_[i].block;
      if (!is_label(block)) continue;
      if (block.label == 0) end_of_sub = i;
      if (block.label != 0) labels_[block.label] = {i, end_of_sub};
    }
    bool has_jumps = false;
    for (const auto& block : blocks_) has_jumps |= jump_target(block.block) != IsoBlock::kNone;
    for (std::size_t i = 0; i + 1 < blocks_.size(); ++i) {
      const IsoBlock& block = blocks_[i].block;
      if (!is_label_call(block) || block.repeats != IsoBlock::kNone) continue;
      const auto label = labels_.find(block.label);
      if (label == labels_.end()) continue;
      for (std::size_t end = 0; end < blocks_.size(); ++end) {
        const bool is_end = is_label(blocks_[end].block) && blocks_[end].block.label == 0;
        if (is_end && (has_jumps || end == label->second.end)) returns_[end].push_back(i + 1);
      }
    }
  }

  void reach(std::size_t at, const ModesBefore& state) {
    if (at < blocks_.size() && merge(before_[at], state)) waiting_.push_back(at);
  }
  void reach_label(std::int32_t label, const ModesBefore& state) {
    if (const auto found = labels_.find(label); found != labels_.end()) {
      reach(found->second.begin, state);
    }
  }

  void pass_on(std::size_t at) {
    const IsoBlock& block = blocks_[at].block;
    ModesBefore state = after(block, before_[at]);
    if (is_label_call(block)) {
      reach_label(block.label, state);
      if (block.repeats != IsoBlock::kNone) reach(at + 1, state);
      return;
    }
    if (const std::int32_t target = jump_target(block); target != IsoBlock::kNone) {
      reach_label(target, state);
    }
    if (const auto found = returns_.find(at); found != returns_.end()) {
      for (const std::size_t site : found->second) reach(site, state);
    }
    if (!is_end_of_run(block)) reach(at + 1, state);
  }

  struct Sub {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  const std::vector<NumberedIsoBlock>& blocks_;
  std::vector<ModesBefore> before_;
  std::vector<std::size_t> waiting_;
  std::map<std::int32_t, Sub> labels_;
  std::map<std::size_t, std::vector<std::size_t>> returns_;  ///< of a LBL 0: after the calls
};

}  // namespace

std::vector<ModesBefore> modes_before(const IsoProgram& program) {
  return ModeFlow(program).run();
}

}  // namespace dripline::tnc_conversion
