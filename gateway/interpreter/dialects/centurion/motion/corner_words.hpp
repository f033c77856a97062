#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// What a block says about the joins of its move: `,R` and `,C` (spec 5.6), BACK (spec 5.7), and
/// whether Trig Help may work its ends out (spec 5.5); how they reach the blending stage, and the
/// control's numbers for what that refuses.
namespace dripline::interpreter::centurion {

/// `at` is on the comma.
bool read_corner_word(Run& run, const char*& at);
/// After the word BACK, which begins at `start`.
bool read_back_words(Run& run, const char* start, const char*& at);

/// Corner words and BACK need a block whose move takes them: error 518. Those of a rapid move mean
/// nothing, but BACK does.
bool check_corner_words(Run& run);

/// Absolute data with Trig Help on: the block's move may be joined to a neighbour of the kind.
bool has_trig_help(const Run& run);
/// On a circle or not, by ten least increments (spec 5.4), in program units.
double arc_tolerance(const Run& run);

/// Before the event of the block's feed move.
void announce_line(Run& run);
/// Before a thread that BACK leads back to the feed move in front of it.
void announce_back(Run& run);
/// With `radius`, in program units, of an arc whose center and radius are exact.
void announce_arc(Run& run, std::optional<double> radius);

ErrorCode code_of(const blending::Fault& fault);

}  // namespace dripline::interpreter::centurion
