#pragma once

#include <optional>

#include "gateway/interpreter/dialects/centurion/cycles/pattern.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter::centurion {

// Mirror, scaling and rotation: the programmed point is mirrored, then scaled, then rotated
// (manual: G511, G551, G568).

/// Points are relative to the active zero, in program units, X a radius.
struct Transformation {
  bool mirrors_x = false;
  bool mirrors_z = false;
  bool scales = false;
  bool rotates = false;
  Point mirror;  ///< where the lines of symmetry are
  Point scale_center;
  Point factor{1, 1};
  Point rotation_center;  ///< scaled already, when scaling was on before rotation
  double degrees = 0;     ///< counterclockwise

  bool mirrors() const { return mirrors_x || mirrors_z; }
  bool is_on() const { return mirrors() || scales || rotates; }
  /// Whether left and right, clockwise and counterclockwise change places.
  bool swaps_sides() const;
  /// The factor of radii (manual: scaling).
  double length_factor() const;
  Point apply(Point point) const;
  Point undo(Point point) const;
};

struct Run;
struct ModalState;

/// Machine coordinates of a point of the program's coordinates, both in program units; the same
/// while nothing is transformed.
Point machine_of(const ModalState& state, const Point& programmed);
Point machine_of(const Run& run, const Point& programmed);
Point programmed_of(const Run& run, const Point& machine);

/// The first stage while anything is transformed. An arc begins at the run's position.
class TransformStage final : public EventFilter {
 public:
  TransformStage(const Run& run, EventSink& next) : EventFilter(next), run_(run) {}

  /// The radius that different factors left an arc is too small for its ends; the arc was not
  /// passed on.
  const std::optional<Origin>& misfit() const { return misfit_; }

  /// Moves an arc that begins at the run's position. False: a misfit.
  bool transform(Arc& arc) const;

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;

 private:
  Position moved(const Position& to) const;
  Point point_of(Length z, Length x) const;
  bool place_center(Arc& arc, const Point& start, const Point& end) const;

  const Run& run_;
  std::optional<Origin> misfit_;
};

}  // namespace dripline::interpreter::centurion
