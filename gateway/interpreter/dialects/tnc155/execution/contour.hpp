#pragma once

#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"

/// How positioning blocks make a contour: radius compensation from start to end, the corners
/// between blocks, and what a block needs of the one before it.
namespace dripline::interpreter::tnc155 {

/// The path of a positioning block in the plane, before it moves.
struct PlaneMove {
  bool is_arc = false;
  bool has_any = false;     ///< names a coordinate of the plane
  bool has_both = false;    ///< names both of them
  bool has_third = false;   ///< and one outside it
  bool has_travel = false;  ///< moves in the plane
  PlaneVector from, to;     ///< nominal
  PlaneVector center;
  Turn turn = Turn::Counterclockwise;
};

/// Before the move: compensation begins, continues, changes or ends; a corner that waits gets its
/// second side.
bool begin_move(Run& run, const Block& block, const PlaneMove& move);
/// After it: M97, M98, the state that the next block continues from.
bool finish_move(Run& run, const Block& block, const PlaneMove& move);

/// RND and chamfers.
bool make_blend(Run& run, const Block& block);

/// Ends a contour other than by R0: TOOL CALL and plane functions; with `keeps_distance`, as M98
/// does, transformations.
void end_contour(Run& run, bool keeps_distance);
/// For moves in between that know no compensation: the block before ends on its own normal. After
/// them the tool is elsewhere and the next block begins a contour (`resume_contour`: M91, the
/// probe), or it is back and the contour continues from the end of its block
/// (`continue_contour`: a cycle).
void interrupt_contour(Run& run);
void resume_contour(Run& run);
void continue_contour(Run& run, const Position& programmed);

/// False after an alarm: a stage found that the contour cannot be run.
bool check_stages(Run& run);

}  // namespace dripline::interpreter::tnc155
