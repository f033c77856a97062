#pragma once

#include <string_view>

#include "gateway/interpreter/dialects/fanuc/run.hpp"

/// What all rough passes along a recorded contour (G71 to G73) have in common.
namespace dripline::interpreter::fanuc {

inline constexpr double kMaxPasses = 5000;

/// `depth` is the axis that the cuts of G71 and G72 step along, `along` the one they run along.
struct Place {
  double depth = 0;
  double along = 0;
};

class Passes {
 public:
  explicit Passes(Run& run);

 protected:
  static constexpr double kClose = 1e-6;

  Place place_of(double x, double z) const { return is_facing_ ? Place{z, x} : Place{x, z}; }
  Place here() const;
  Position on_machine(Place at) const;

  // False: an alarm.
  bool rapid(Place to);
  bool feed(Place to);
  /// Down to a level where the cuts begin: as the block of P moves.
  bool approach(Place to);
  bool arc(const ContourMove& move, Place to);
  /// The moves from `first` on, shifted.
  bool follow(std::size_t first, double x, double z);

  bool refuse(std::string_view why);
  /// Move 0 is that of the block of P.
  bool refuse_beyond(std::size_t move);
  /// The allowance leads off the work in the depth, and against the cuts along them.
  bool check_allowance();

  Run& run_;
  const ContourCycle& cycle_;
  bool is_facing_;
  Place start_;
  Place first_;
  double out_ = 1;      ///< from the contour to the start
  double forward_ = 1;  ///< of the cuts
};

/// G71 and G72 of type II; pocket_roughing.cpp.
bool rough_pockets(Run& run);

}  // namespace dripline::interpreter::fanuc
