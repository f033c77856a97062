#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// What a lathe (T series) has of its own: words in increments, turrets, threads and cycles. The
/// rest of the language is that of the machining centers.
namespace dripline::interpreter::fanuc {

/// U, V, W and H of G-code system A become the X, Y, Z and C that they lead to. False: an alarm.
bool resolve_increments(Run& run);
/// T0101: tool and offset at once.
bool select_turret(Run& run);
/// G10 P X Z R Q: an offset of a tool.
bool set_turret_offset(Run& run);

/// The lead that a program gives (mm) is that of the axis with the longer travel, an event's that
/// of the path.
Length lead_of_path(const Position& from, const Position& to, double lead);
/// G32 (G33), G34: `run.state.feed[1]` is the lead along the longer axis.
bool cut_turned_thread(Run& run, const Position& to);
/// The modal cycles of one cut: G90, G92 and G94 of system A.
bool cut_box(Run& run);
/// G70 to G76.
bool execute_turning_cycle(Run& run);

// Of G70 to G73, whose contour is blocks of the program (contour.cpp).

/// The block in hand begins or is within such a contour: what the cycle does at its end. Called
/// when the block is left, with `run.state.at` after it. False: an alarm.
bool follow_contour(Run& run);
/// Whether the block in hand may be within a contour. False: an alarm.
bool check_contour_block(Run& run);
/// Rapidly from the end of the recorded contour to `to`, where a pass begins or the cycle did:
/// first along the axis that leads off the work, where the straight path may lead through a
/// shoulder. False: an alarm.
bool leave_contour(Run& run, const Position& to);
/// Rough passes along what has been recorded; roughing.cpp, pocket_roughing.cpp.
bool make_passes(Run& run);

}  // namespace dripline::interpreter::fanuc
