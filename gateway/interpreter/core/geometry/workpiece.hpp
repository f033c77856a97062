#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// A plane across one linear axis. Across Z the material is on the side of smaller Z; across the
/// other axes it may be on either side.
struct ProbePlane {
  Axis axis = Axis::Z;
  Length at;
};
/// An upright cylinder (boss or bore, so with material on either side) of unlimited height.
struct ProbeCylinder {
  Length center_x, center_y, radius;
};
/// A turned part's outline in radius: points (X radius, Z) connected by straight lines; solid on
/// the side of smaller Z, without end. Nothing is solid beyond its smallest and
/// largest X.
struct ProbeProfile {
  struct Point {
    Length x, z;
  };
  std::vector<Point> points;
};

/// The simulated workpiece a probe meets. Value type; pure.
class Workpiece {
 public:
  using Surface = std::variant<ProbePlane, ProbeCylinder, ProbeProfile>;
  void add(Surface surface) { surfaces_.push_back(std::move(surface)); }
  bool empty() const { return surfaces_.empty(); }

  /// Contact: where the move first meets a surface or goes into one it starts on; at its
  /// start when it begins inside a profile, or under a plane across Z and moves along Z. Release:
  /// where it first leaves the surface it starts on or after. A surface with material on either
  /// side is met and left by any crossing. With no such point the probe is not tripped and `at` is
  /// the end of the move. Positions within a millionth of a millimeter of a surface are on it. An
  /// arc lies in the plane ZX; one that ends off its circle is met on that of its start.
  ProbeResult probe(const Probe& move) const;
  /// A straight move.
  ProbeResult probe(const Position& from, const Position& to, ProbeUntil until) const {
    return probe({.origin = {}, .from = from, .to = to, .until = until, .feed = {}, .result = {}});
  }

 private:
  std::vector<Surface> surfaces_;
};

}  // namespace dripline::interpreter
