#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/cycles/cycle_motion.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// Rounding of the last digits makes no step of its own.
constexpr double kSliver = 1e-9;

double height_of(const CycleMotion& motion, const MachiningCycle& cycle, double peck) {
  const double surface = motion.start_height() + cycle.clearance;
  const double deep = std::min(peck * std::fabs(cycle.peck), std::fabs(cycle.depth));
  return surface + std::copysign(deep, cycle.depth);
}

int steps_to(double distance, double step) {
  return std::max(1, static_cast<int>(std::ceil(distance / step - kSliver)));
}

PlaneVector along(int place, double distance) {
  return place == 0 ? PlaneVector{distance, 0} : PlaneVector{0, distance};
}

/// One turn of a rectangular spiral: half its sides along the long and the short axis.
struct Ring {
  double along = 0;
  double across = 0;
  double begin = 1;  ///< at the middle of the side that the long axis points to; -1: of the other
};

/// Round the pocket's center.
void run_ring(CycleMotion& motion, int long_place, Ring ring, Turn turn, double feed) {
  const PlaneVector center = motion.start();
  const auto at = [&](double a, double b) {
    return center + along(long_place, ring.begin * a) + along(1 - long_place, ring.begin * b);
  };
  // Counterclockwise the first corner is on the left of the long axis' direction, which is the
  // positive side of the second axis and the negative of the first.
  const double left = long_place == 0 ? 1 : -1;
  const double first = turn == Turn::Counterclockwise ? left : -left;
  motion.feed_to(at(ring.along, 0), feed);
  motion.feed_to(at(ring.along, first * ring.across), feed);
  motion.feed_to(at(-ring.along, first * ring.across), feed);
  motion.feed_to(at(-ring.along, -first * ring.across), feed);
  motion.feed_to(at(ring.along, -first * ring.across), feed);
  motion.feed_to(at(ring.along, 0), feed);
}

}  // namespace

void mill_slot(CycleMotion& motion, const MachiningCycle& cycle) {
  const int place = motion.place_of(cycle.first_axis);
  const double reach = std::fabs(cycle.first_side) - 2 * motion.tool_radius();
  const double travel = std::copysign(reach, cycle.first_side);
  const PlaneVector near = motion.start(), far = near + along(place, travel);
  bool is_far = false;
  const auto pecks = static_cast<int>(pecks_of(cycle));
  for (int peck = 1; peck <= pecks; ++peck) {
    motion.feed_to_height(height_of(motion, cycle, peck), cycle.plunge_feed);
    is_far = !is_far;
    motion.feed_to(is_far ? far : near, cycle.feed);
  }
  const PlaneVector here = is_far ? far : near, other = is_far ? near : far;
  // Climb milling inside is counterclockwise, so the wall on the right of the travel to the other
  // end comes first.
  const double half = std::fabs(cycle.second_side) / 2 - motion.tool_radius();
  const double ahead = (is_far ? -1 : 1) * (travel < 0 ? -1 : 1);
  const double handed = place == 0 ? 1 : -1;
  const double turned = motion.turn_for(Turn::Counterclockwise) == Turn::Counterclockwise ? 1 : -1;
  const PlaneVector aside = along(1 - place, -ahead * handed * turned * half);
  for (const PlaneVector to :
       {here + aside, other + aside, other - aside, here - aside, here + aside, here}) {
    motion.feed_to(to, cycle.feed);
  }
  motion.rapid_to_height(motion.start_height());
  motion.rapid_to(near);
}

void mill_pocket(CycleMotion& motion, const MachiningCycle& cycle, double step) {
  const double radius = motion.tool_radius();
  double sides[2] = {};
  sides[motion.place_of(cycle.first_axis)] = std::fabs(cycle.first_side) / 2 - radius;
  sides[motion.place_of(cycle.second_axis)] = std::fabs(cycle.second_side) / 2 - radius;
  const int long_place = sides[0] > sides[1] ? 0 : 1;
  const double narrow = sides[1 - long_place];
  const double surplus = sides[long_place] - narrow;
  const double begin = surplus > kSliver ? -1 : 1;  // where the first pass has led
  const int rings = steps_to(narrow, step);
  const Turn turn = motion.turn_for(cycle.turn);
  const auto pecks = static_cast<int>(pecks_of(cycle));
  for (int peck = 1; peck <= pecks; ++peck) {
    motion.feed_to_height(height_of(motion, cycle, peck), cycle.plunge_feed);
    if (surplus > kSliver) {
      motion.feed_to(motion.start() + along(long_place, surplus), cycle.feed);
      motion.feed_to(motion.start() + along(long_place, -surplus), cycle.feed);
    }
    for (int ring = 1; ring <= rings; ++ring) {
      const double out = narrow * ring / rings;
      run_ring(motion, long_place, {surplus + out, out, begin}, turn, cycle.feed);
    }
    motion.feed_to(motion.start(), cycle.feed);
  }
  motion.rapid_to_height(motion.start_height());
}

void mill_circle(CycleMotion& motion, const MachiningCycle& cycle, double step) {
  const double radius = cycle.radius - motion.tool_radius();
  const int rings = steps_to(radius, step);
  const Turn turn = motion.turn_for(cycle.turn);
  const PlaneVector center = motion.start();
  const auto pecks = static_cast<int>(pecks_of(cycle));
  for (int peck = 1; peck <= pecks; ++peck) {
    motion.feed_to_height(height_of(motion, cycle, peck), cycle.plunge_feed);
    // Half circles that grow by half a step, leaving the center along the second axis.
    double at = 0;
    double side = turn == Turn::Counterclockwise ? -1 : 1;
    for (int half = 1; half <= 2 * rings; ++half, side = -side) {
      const double to = side * radius * half / (2 * rings);
      motion.arc_to(center + along(0, to), center + along(0, (at + to) / 2), turn, cycle.feed);
      at = to;
    }
    motion.circle(center, turn, cycle.feed);
    motion.feed_to(center, cycle.feed);
  }
  motion.rapid_to_height(motion.start_height());
}

}  // namespace dripline::interpreter::tnc155
