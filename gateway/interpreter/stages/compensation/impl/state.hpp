#pragma once

#include <optional>

#include "gateway/interpreter/stages/compensation/impl/element.hpp"
#include "gateway/interpreter/stages/look_ahead/look_ahead_stage.hpp"

namespace dripline::interpreter::compensation::impl {

enum class Phase : std::uint8_t {
  Off,
  Starting,  ///< the next move in the plane is the start-up move
  On,
  Ending,    ///< the next move in the plane is the cancel move
  Parallel,  ///< the next move in the plane keeps the tool's distance, then off
};

/// Everything that decides the rest of the path, in a few fixed kilobytes; `visit_state`
/// (state.cpp) lists the members: add new ones there too.
struct State : look_ahead::StageState<Element, look_ahead::HeldEvents<>> {
  static constexpr std::string_view kName = "compensation";

  Phase phase = Phase::Off;
  /// The tool is not on the programmed point of the plane, and stays where it is until the next
  /// move in the plane.
  bool is_displaced = false;
  bool is_output_suppressed = false;  ///< moves are silent elements
  double offset = 0;                  ///< to the left
  PlaneVector tip;                    ///< from the nose center to the positioned point
  StartUp start_up = StartUp::NextNormal;
  std::optional<OutsideCorner> next_corner;
  std::optional<ByArc> next_arc;  ///< of the cancel move
  bool begins_contour = false;    ///< Parallel: a contour begins where that move ends
  int idle_blocks = 0;            ///< without motion in the plane, since the waiting element
};

}  // namespace dripline::interpreter::compensation::impl
