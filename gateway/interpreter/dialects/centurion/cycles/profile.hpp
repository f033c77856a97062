#pragma once

#include <optional>
#include <vector>

#include "gateway/interpreter/dialects/centurion/cycles/pattern.hpp"

/// The contour that roughing cuts down to, seen along the direction of the cuts. Pure.
namespace dripline::interpreter::centurion {

/// Lengths closer than this are one, in millimeters.
inline constexpr double kSameLength = 1e-6;

/// `depth` grows out of the work, `along` grows with the cut: all four kinds of turning and of
/// facing look the same.
struct ProfilePoint {
  double depth = 0;
  double along = 0;
};

class ProfileFrame {
 public:
  /// `out`: +1 where the work is toward smaller positions. `cut`: the direction of the cuts.
  ProfileFrame(bool is_facing, int out, int cut) : is_facing_(is_facing), out_(out), cut_(cut) {}
  ProfilePoint of(const PlanePoint& point) const {
    return is_facing_ ? ProfilePoint{out_ * point.z, cut_ * point.x}
                      : ProfilePoint{out_ * point.x, cut_ * point.z};
  }
  PlanePoint back(const ProfilePoint& point) const {
    return is_facing_ ? PlanePoint{cut_ * point.along, out_ * point.depth}
                      : PlanePoint{out_ * point.depth, cut_ * point.along};
  }
  /// Whether counterclockwise stays counterclockwise (along to the right, depth up).
  bool keeps_rotation() const { return (out_ * cut_ > 0) != is_facing_; }

 private:
  bool is_facing_;
  int out_;
  int cut_;
};

/// A part of the contour on which depth and along are both monotonic.
struct ProfilePiece {
  ProfilePoint from;
  ProfilePoint to;
  bool is_arc = false;
  bool is_counterclockwise = false;  ///< in the frame
  bool is_upper = false;             ///< of its circle
  ProfilePoint center;
  double radius = 0;
};
using Profile = std::vector<ProfilePiece>;

/// Where a cut at one level is free: from where the contour goes down through the level (or the
/// start of the cut) to where it comes up.
struct OpenInterval {
  double from = 0;
  double to = 0;
  bool is_open_at_start = false;
  std::size_t closing_piece = 0;  ///< size of the profile: it never comes up
};

/// Adds the pieces of one move.
void add_line(Profile& profile, const ProfilePoint& from, const ProfilePoint& to);
struct ProfileArc {
  ProfilePoint from;
  ProfilePoint to;
  ProfilePoint center;
  bool is_counterclockwise = false;
  double sweep = 0;  ///< degrees
};
void add_arc(Profile& profile, const ProfileArc& arc);
void shift(Profile& profile, double depth, double along);

/// In order along the cut, which begins at `start`.
std::vector<OpenInterval> open_at(const Profile& profile, double level, double start);
/// Where along the cut a piece reaches `level`.
double along_at(const ProfilePiece& piece, double level);
/// The highest contour between two places; nothing where there is none.
std::optional<double> highest_between(const Profile& profile, double from, double to);

}  // namespace dripline::interpreter::centurion
