#pragma once

#include <optional>

#include "gateway/interpreter/core/geometry/profile.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Rough turning and facing (manual: G71, G72): parallel cuts down to the pattern with
/// all its stock.

namespace dripline::interpreter::centurion {

/// Writes the moves of a cycle that follows a pattern, after the compensation stage: the pattern is
/// compensated already.
class PassWriter {
 public:
  explicit PassWriter(Run& run) : run_(run), cycle_(run.state.pattern) {}

  const PlanePoint& tool() const { return cycle_.tool; }
  void rapid(const PlanePoint& to);
  void line(const PlanePoint& to, Feed feed);
  void arc(const PlanePoint& to, const PlanePoint& center, bool is_clockwise, Feed feed);
  /// A move of the pattern, shifted by `stock`. `feed`, if given, replaces its own feed, and
  /// speeds are omitted.
  void follow(const PatternMove& move, const PlanePoint& stock, std::optional<Feed> feed);

 private:
  bool is_at(const PlanePoint& to) const;
  Position position_of(const PlanePoint& to);
  void arrive(const PlanePoint& to);

  Run& run_;
  PatternCycle& cycle_;
};

/// How the cuts lie: all four kinds of turning and of facing look the same in the frame.
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

struct Roughing {
  ProfileFrame frame;
  ProfilePieces profile;  ///< the pattern without its first move, and the shoulder; with all stock
  ProfilePoint start;
  double first_level = 0;
  double step = 0;
  double relief = 0;
  bool relief_is_45 = false;
  Feed feed;
};

/// Checks the contour of the cycle's moves: 582-587 when the pattern cannot be roughed.
bool check_roughing(Run& run);
/// From a cycle that passed the check.
Roughing roughing_of(const PatternCycle& cycle);

/// Cut `number` of 0, 1, ...; false when nothing is left at its level.
bool cut_level(PassWriter& writer, const Roughing& roughing, std::uint32_t number);
/// Along the pattern with the finish stock only, out to the start, and back to it.
void cut_contour(Run& run, PassWriter& writer);

}  // namespace dripline::interpreter::centurion
