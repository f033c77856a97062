#include "clients/tools/tnc_conversion/rounding_use.hpp"

#include <algorithm>

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

/// Cycles 7, 8, 10 and 11 end a contour with their second sub-block.
bool is_transformation(const Block& block) {
  const bool is_one =
      block.cycle == 7 || block.cycle == 8 || block.cycle == 10 || block.cycle == 11;
  return is_one && block.part > 0;
}

/// The axis across the plane that tools of the called axis work in.
std::optional<Axis> normal_of(const Block& call) {
  if (call.is_fourth_axis) return std::nullopt;
  switch (*call.axis) {
    case Axis::X:
    case Axis::U:
    case Axis::A:
      return Axis::X;
    case Axis::Y:
    case Axis::V:
    case Axis::B:
      return Axis::Y;
    default:
      return Axis::Z;
  }
}

}  // namespace

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

CompensationTrack::CompensationTrack(std::span<const Block> blocks) {
  is_never_on_ = std::none_of(blocks.begin(), blocks.end(), [](const Block& block) {
    return block.compensation == Compensation::Left || block.compensation == Compensation::Right ||
           block.kind == BlockKind::ProgramCall ||
           (block.kind == BlockKind::CycleDefinition && block.cycle == 12);
  });
}

void CompensationTrack::pass(const Block& block) {
  calls_programs_ |= block.kind == BlockKind::CycleDefinition && block.cycle == 12;
  is_modal_call_ |= block.m == 89;
  if (is_flow(block) || may_run_program(block)) return open();
  switch (block.kind) {
    case BlockKind::Begin:
      return end();
    case BlockKind::ToolCall:
      if (block.axis || block.is_fourth_axis) normal_ = normal_of(block);
      if (block.axis || block.is_fourth_axis || block.target != Block::kNone) end();
      return;
    case BlockKind::CycleDefinition:
      if (is_transformation(block)) end();
      return;
    case BlockKind::SingleAxis:
      if (block.compensation != Compensation::NotProgrammed) end();
      return;
    default:
      break;
  }
  if (is_path(block) || block.kind == BlockKind::Line) pass_move(block);
}

/// A called program may leave compensation as it likes.
void CompensationTrack::open() {
  if (is_never_on_) return;
  is_on_ = is_begun_ = is_first_ = Answer::Unknown;
}

bool CompensationTrack::may_run_program(const Block& block) const {
  if (!calls_programs_) return false;
  const bool moves = is_path(block) || block.kind == BlockKind::SingleAxis;
  return block.kind == BlockKind::CycleCall || block.m == 99 || block.m == 89 ||
         (is_modal_call_ && moves);
}

void CompensationTrack::end() {
  is_on_ = is_begun_ = is_first_ = Answer::No;
}

void CompensationTrack::pass_move(const Block& block) {
  if (block.compensation == Compensation::Off) end();
  if (block.m == 91 || block.m == 92) return;  // moves without compensation
  if (block.compensation == Compensation::Left || block.compensation == Compensation::Right) {
    if (is_on_ == Answer::No) is_begun_ = Answer::Yes;
    if (is_on_ == Answer::Unknown) is_begun_ = Answer::Unknown;
    is_on_ = Answer::Yes;
  }
  const Answer names = names_plane(block);
  is_first_ = names == Answer::Yes ? is_begun_ : Answer::No;
  if (names == Answer::Yes) is_begun_ = Answer::No;
  if (names == Answer::Unknown && is_begun_ == Answer::Yes) {
    is_first_ = is_begun_ = Answer::Unknown;
  }
  if (block.m == 98) end();
}

CompensationTrack::Answer CompensationTrack::names_plane(const Block& block) const {
  if (block.kind != BlockKind::Line) return Answer::Yes;
  int known = 0;
  int all = 0;
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    const Axis axis = block.coordinates[i].axis;
    all += axis <= Axis::Z ? 1 : 0;
    known += axis <= Axis::Z && axis != normal_ ? 1 : 0;
  }
  if (normal_) return known > 0 ? Answer::Yes : Answer::No;
  return all == 0 ? Answer::No : all == 1 ? Answer::Unknown : Answer::Yes;
}

RoundingUse CompensationTrack::use_of(std::span<const Block> blocks, std::size_t at) const {
  if (is_on_ == Answer::No) return RoundingUse::Corner;
  if (is_on_ == Answer::Unknown || is_first_ == Answer::Unknown) return RoundingUse::Unstated;
  if (is_first_ == Answer::Yes) return RoundingUse::TangentialApproach;
  for (std::size_t next = at + 1; next < blocks.size(); ++next) {
    if (is_flow(blocks[next]) && blocks[next].kind != BlockKind::Label) break;
    if (!is_path(blocks[next])) continue;
    return blocks[next].compensation == Compensation::Off ? RoundingUse::TangentialDeparture
                                                          : RoundingUse::Corner;
  }
  return RoundingUse::Unstated;
}

}  // namespace dripline::tnc_conversion
