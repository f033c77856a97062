#pragma once

#include <cstddef>
#include <optional>
#include <vector>

/// The contour that roughing cuts down to, seen along the direction of the cuts. Pure.
namespace dripline::interpreter {

/// Lengths closer than this are one, in millimeters.
inline constexpr double kSameLength = 1e-6;

/// `depth` grows out of the work, `along` grows with the cut: all four kinds of turning and of
/// facing look the same.
struct ProfilePoint {
  double depth = 0;
  double along = 0;
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
using ProfilePieces = std::vector<ProfilePiece>;

/// Where a cut at one level is free: from where the contour goes down through the level (or the
/// start of the cut) to where it comes up.
struct OpenInterval {
  double from = 0;
  double to = 0;
  bool is_open_at_start = false;
  std::size_t opening_piece = 0;  ///< unless it is open at the start
  std::size_t closing_piece = 0;  ///< size of the profile: it never comes up
};

/// Adds the pieces of one move.
void add_line(ProfilePieces& profile, const ProfilePoint& from, const ProfilePoint& to);
struct ProfileArc {
  ProfilePoint from;
  ProfilePoint to;
  ProfilePoint center;
  bool is_counterclockwise = false;
  double sweep = 0;  ///< degrees
};
void add_arc(ProfilePieces& profile, const ProfileArc& arc);
void shift(ProfilePieces& profile, double depth, double along);

/// Of a piece, at a place along the cut; of a wall the higher end.
double depth_at(const ProfilePiece& piece, double along);
/// In order along the cut, which begins at `start`.
std::vector<OpenInterval> open_at(const ProfilePieces& profile, double level, double start);
/// Where along the cut a piece reaches `level`.
double along_at(const ProfilePiece& piece, double level);
/// The highest contour between two places; nothing where there is none.
std::optional<double> highest_between(const ProfilePieces& profile, double from, double to);

}  // namespace dripline::interpreter
