#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gateway/interpreter/core/geometry/profile.hpp"

/// The cuts of G71 and G72 of type II, whose contour may go down again: pockets. Pure; lengths in
/// millimeters.
namespace dripline::interpreter::fanuc {

/// All places are in the frame of the cuts (profile.hpp).
struct PocketCuts {
  /// The contour with its allowance, from where the cuts begin, or from the depth straight below,
  /// to a wall at its end. Along the cut it is monotonic, and not beyond `begin` in the depth.
  ProfilePieces profile;
  ProfilePoint begin;
  double depth = 0;   ///< of a cut, above 0
  double escape = 0;  ///< off the work after a cut
};

struct PassMove {
  enum class Kind : std::uint8_t {
    Rapid,
    Approach,  ///< down to a level where the cuts begin: as the block of P moves
    Line,
    Arc,  ///< of a quarter at most
  };
  Kind kind = Kind::Line;
  ProfilePoint to;
  ProfilePoint center = {};
  bool is_counterclockwise = false;
};

/// How often the contour goes down after it has come up, or after its first point.
std::size_t count_pockets(const PocketCuts& cuts);

/// Whether `shifted` is somewhere deeper than `part`, of which it is a copy.
bool reaches_into(const ProfilePieces& shifted, const ProfilePieces& part);

/// The cuts at all levels, each along the contour from the level before and up to it again; the
/// tool is at `begin` before. Nothing when there are more than `max_cuts`.
std::optional<std::vector<PassMove>> cut_pockets(const PocketCuts& cuts, std::size_t max_cuts);

}  // namespace dripline::interpreter::fanuc
