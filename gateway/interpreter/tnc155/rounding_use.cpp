#include "gateway/interpreter/tnc155/rounding_use.hpp"

namespace dripline::interpreter::tnc155 {

bool is_path(const Block& block) {
  switch (block.kind) {
    case BlockKind::Line:
      return block.coordinate_count > 0;
    case BlockKind::PolarLine:
    case BlockKind::Arc:
    case BlockKind::PolarArc:
    case BlockKind::TangentArc:
      return true;
    default:
      return false;
  }
}

bool is_flow(const Block& block) {
  return block.kind == BlockKind::Label || block.kind == BlockKind::LabelCall ||
         block.kind == BlockKind::ProgramCall ||
         (block.kind == BlockKind::Function && block.function >= 9);
}

void CompensationTrack::pass(const Block& block) {
  if (is_flow(block)) {
    state_ = State::Unknown;
    return;
  }
  if (block.kind == BlockKind::ToolCall || block.kind == BlockKind::Begin) state_ = State::Off;
  if (!is_path(block) && block.kind != BlockKind::Line) return;
  before_last_move_ = state_;
  if (block.compensation == Compensation::Off) state_ = State::Off;
  if (block.compensation == Compensation::Left || block.compensation == Compensation::Right) {
    state_ = State::On;
  }
  if (block.m == 98) state_ = State::Off;
}

RoundingUse CompensationTrack::use_of(std::span<const Block> blocks, std::size_t at) const {
  if (state_ == State::Off) return RoundingUse::Corner;
  if (state_ == State::Unknown || before_last_move_ == State::Unknown) return RoundingUse::Unstated;
  if (before_last_move_ == State::Off) return RoundingUse::RunOn;
  for (std::size_t next = at + 1; next < blocks.size(); ++next) {
    if (is_flow(blocks[next]) && blocks[next].kind != BlockKind::Label) break;
    if (!is_path(blocks[next])) continue;
    return blocks[next].compensation == Compensation::Off ? RoundingUse::RunOff
                                                          : RoundingUse::Corner;
  }
  return RoundingUse::Unstated;
}

}  // namespace dripline::interpreter::tnc155
