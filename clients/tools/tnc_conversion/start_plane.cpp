#include "clients/tools/tnc_conversion/start_plane.hpp"

#include "gateway/interpreter/dialects/tnc155/reading/iso_block.hpp"

namespace dripline::tnc_conversion {

using namespace interpreter;
using namespace interpreter::tnc155;

namespace {

constexpr std::uint8_t kFirstPlane = 17;

bool is_plain_tail(const Block& block) {
  return block.compensation <= Compensation::Off && block.m != 89 && (block.m < 95 || block.m > 99);
}

/// Cycles that are only kept, the datum shift and the dwell; the rest works in a plane at once.
bool is_any_plane_cycle(int cycle) {
  return cycle <= 5 || cycle == 7 || cycle == 9;
}

/// The block has the same effect in all planes, and the run continues after it.
bool is_same_in_all_planes(const Block& block) {
  switch (block.kind) {
    case BlockKind::Begin:
    case BlockKind::End:
    case BlockKind::ToolDefinition:
    case BlockKind::Label:
    case BlockKind::BlankForm:
      return true;
    case BlockKind::ToolCall:  // the length of a tool lies along its axis
      return block.target <= 0;
    case BlockKind::Stop:
    case BlockKind::Line:
    case BlockKind::SingleAxis:
      return is_plain_tail(block);
    case BlockKind::Function:
      return block.function < 9;
    case BlockKind::CycleDefinition:
      return is_any_plane_cycle(block.cycle);
    default:
      return false;
  }
}

}  // namespace

std::uint8_t start_plane(std::span<const Block> blocks) {
  std::optional<Axis> axis;
  for (const Block& block : blocks) {
    const bool names_tool_axis =
        block.kind == BlockKind::ToolCall && (block.axis || block.is_fourth_axis);
    const bool is_blank = block.kind == BlockKind::BlankForm && !block.is_maximum;
    if (!axis && (names_tool_axis || is_blank)) axis = block.axis.value_or(Axis::Z);
    if (names_tool_axis) break;
    if (!is_same_in_all_planes(block)) return kFirstPlane;
  }
  return plane_of_axis(axis.value_or(Axis::Z)).value_or(kFirstPlane);
}

}  // namespace dripline::tnc_conversion
