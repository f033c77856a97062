#pragma once

#include <string_view>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"

namespace dripline::interpreter::tnc155 {

/// Whether a block may be a rounding or a chamfer, which changes the move before it. The test is
/// cheap and true for some other blocks too; `is_blend` on the block as read decides.
bool may_be_blend(std::string_view text, Form form);

inline bool is_blend(const Block& block) {
  return block.kind == BlockKind::Rounding || block.kind == BlockKind::Chamfer;
}
inline bool is_positioning(const Block& block) {
  switch (block.kind) {
    case BlockKind::Line:
    case BlockKind::PolarLine:
    case BlockKind::Arc:
    case BlockKind::PolarArc:
    case BlockKind::TangentArc:
    case BlockKind::RadiusArc:
    case BlockKind::Approach:
    case BlockKind::Departure:
      return true;
    default:
      return false;
  }
}

}  // namespace dripline::interpreter::tnc155
