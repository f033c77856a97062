#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gateway/app/restart/reached_heights.hpp"
#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

/// What a program has given to the machine up to some event: what a restart after that event has to
/// bring back. The look-ahead stages may still hold events of the same blocks.
struct DeliveredState {
  interpreter::Origin ended;       ///< the block whose end came last
  interpreter::Position position;  ///< commanded last; marks the axes that have moved
  ReachedHeights heights;
  interpreter::Spindle spindle;
  bool flood = false, mist = false;
  std::optional<int> tool, tool_offset, next_tool;
  std::optional<interpreter::ToolShape> tool_shape;
  std::optional<Feed> feed;  ///< of the last move that had one
  interpreter::OverrideInhibit inhibit;
  /// M functions and outputs that the control hands to the machine, each once, the latest last.
  std::vector<int> codes;
  std::uint64_t path = kEmptyPath;  ///< hash of all moves and what goes with them

  static constexpr std::uint64_t kEmptyPath = 0x9e3779b97f4a7c15ULL;
  static constexpr std::size_t kMaxCodes = 32;
  /// An output's code: kOutput + its axis * 100 + its number.
  static constexpr int kOutput = 100'000;
};

/// For the state archive.
template <class Archive>
void visit(Archive& archive, DeliveredState& state) {
  archive(state.ended, state.position, state.heights, state.spindle, state.flood, state.mist,
          state.tool, state.tool_offset, state.next_tool, state.tool_shape, state.feed,
          state.inhibit, state.codes, state.path);
  if (state.codes.size() > DeliveredState::kMaxCodes) archive.damage();
}

}  // namespace dripline::gateway
