#pragma once

#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/run.hpp"

/// Straight moves, arcs and probing, and how all moves reach the sink (NIST 3.5).
namespace dripline::interpreter::rs274ngc {

using AxisBits = std::uint16_t;
constexpr AxisBits bit_of(Axis axis) {
  return static_cast<AxisBits>(1u << index_of(axis));
}

/// Where a move goes: program coordinates, and the axes that its line names.
struct Target {
  Axes to{};
  AxisBits named = 0;
};

/// @ and ^ appear without X and Y, in G17.
bool check_polar_words(Run& run);
/// The end of the line's move out of its words, G53 and distance mode.
bool read_target(Run& run, Target& target);

/// The feed of this line's move. Errors: none is in force, or the line lacks the F of G93.
bool read_feed(Run& run, bool is_arc, Feed& feed);

/// In G93 the control makes a speed of F and the length (mm or degrees) of the path as programmed:
/// what #<_feed> shows and M70 keeps.
void note_speed(Run& run, double length);

/// G0 and G1.
bool straight_move(Run& run, int motion);
/// G28 and G30.
bool home_move(Run& run, int g_code);

/// These move the state along and deliver the event; a move of no length is none.
void rapid_to(Run& run, const Target& target);
void line_to(Run& run, const Target& target, const Feed& feed);
void move_to(Run& run, const Target& target, bool is_rapid, const Feed& feed);
/// One of the pieces that a curve is made of comes to rest only where the curve ends.
void line_to(Run& run, const Target& target, const Feed& feed, bool rests);
/// Arrives there and gives the machine point: for events made elsewhere.
const Position& arrive(Run& run, const Target& target);

struct ArcShape {
  double center_first = 0, center_second = 0;  ///< program coordinates, mm
  Turn turn = Turn::Clockwise;
  double sweep = 0;  ///< degrees, > 0
};
bool arc_to(Run& run, const Target& target, const ArcShape& shape, const Feed& feed);
/// The word of the center along an axis: I, J, K for X, Y, Z.
constexpr char offset_word(Axis axis) {
  return static_cast<char>('I' + index_of(axis));
}

/// G2 and G3; arcs.cpp.
bool arc_move(Run& run, bool is_clockwise);
/// The center of an arc of the plane out of the words of its line, which are checked.
bool arc_center(Run& run, PlaneVector start, PlaneVector end, Turn turn, PlaneVector& center);

/// Degrees from `start` to `end` about `center` in the direction of `turn`; a full turn when the
/// two are as good as the same. Pure.
double sweep_of(PlaneVector center, PlaneVector start, PlaneVector end, Turn turn);
inline double distance(PlaneVector a, PlaneVector b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

/// G38.2 to G38.5 (probe.cpp). Asks for the probe's result; with the answer the line is finished.
bool probe_move(Run& run, int g_code);

}  // namespace dripline::interpreter::rs274ngc
