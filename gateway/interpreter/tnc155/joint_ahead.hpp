#pragma once

#include <string_view>

#include "gateway/interpreter/tnc155/block.hpp"
#include "gateway/interpreter/tnc155/reading_state.hpp"

namespace dripline::interpreter::tnc155 {

/// Whether a block's text may begin with a rounding or a chamfer, which says something about the
/// move before it: cheap, and true of some others. `is_joint` of what the text reads as decides.
bool may_be_joint(std::string_view text, Form form);

inline bool is_joint(const Block& block) {
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
