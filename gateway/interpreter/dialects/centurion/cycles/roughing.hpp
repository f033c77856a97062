#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/cycles/profile.hpp"
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

struct Roughing {
  ProfileFrame frame;
  Profile profile;  ///< the pattern without its first move, and the shoulder; with all stock
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
