#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// The words for the corner between a block's move and its neighbor: `,R` and `,C`, BACK, and
/// whether Trig Help may compute the ends; how they reach the blending stage, and the control's
/// numbers for what that stage refuses. (Manual: corner rounding and chamfer; BACK lines; Trig
/// Help.)
namespace dripline::interpreter::centurion {

/// `at` is on the comma.
bool read_corner_word(Run& run, const char*& at);
/// After the word BACK, which begins at `start`.
bool read_back_words(Run& run, const char* start, const char*& at);

/// Corner words and BACK need a block whose move uses them: error 518. On a rapid move corner words
/// have no effect, BACK is an error.
bool check_corner_words(Run& run);

/// Whether Trig Help may compute the ends of the block's move: absolute data, with Trig Help on.
bool has_trig_help(const Run& run);
/// A point within ten least increments of a circle is on it; in program units.
double arc_tolerance(const Run& run);

/// Before the event of the block's feed move.
void announce_line(Run& run);
/// Before a thread that BACK extends back to the feed move before it.
void announce_back(Run& run);
/// With `radius`, in program units, of an arc whose center and radius are exact.
void announce_arc(Run& run, std::optional<double> radius);

ErrorCode code_of(const blending::Fault& fault);

}  // namespace dripline::interpreter::centurion
