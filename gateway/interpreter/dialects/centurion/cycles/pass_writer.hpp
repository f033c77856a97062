#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

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

}  // namespace dripline::interpreter::centurion
