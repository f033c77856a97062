#pragma once

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

/// What the manual wants of moves that do not come to rest (manual: G01, quill, M functions,
/// buffering).
namespace dripline::interpreter::tektronix1704 {

using Direction = std::array<double, kAxes>;

/// A move about to be made, in counts.
struct PlannedMove {
  Direction begin{}, end{};  ///< directions, not of unit length
  double length = 0;         ///< counts
  double feed = 0;           ///< mm per minute
  bool flows = false;        ///< no rest at its end
};

/// Judges the move before against this one, and remembers this one. False: alarm.
void check_turn(Run& run, const PlannedMove& move);
/// The slides are about to rest for good: M00, M02, G04 ... False: alarm (strict).
bool check_stop(Run& run);
/// Before the quill moves.
void check_quill(Run& run);
/// An M word in this block; `moves`: the block is itself such a move.
void check_m_word(Run& run, int code, bool moves);

}  // namespace dripline::interpreter::tektronix1704
