#pragma once

#include <string_view>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"

namespace dripline::interpreter::tnc155 {

/// Whether a block's text may begin with a rounding or a chamfer, which says something about the
/// move before it: cheap, and true of some others. `is_blend` of what the text reads as decides.
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
      return true;
    default:
      return false;
  }
}

}  // namespace dripline::interpreter::tnc155
