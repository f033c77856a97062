#pragma once

#include <optional>
#include <string>

#include "gateway/interpreter/dialects/centurion/errors.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter::centurion {

/// A rectangle of the machine, millimeters, X a radius.
struct TravelArea {
  double min_x = 0, max_x = 0;
  double min_z = 0, max_z = 0;
};

struct TravelFault {
  ErrorCode code;
  Origin origin;
  std::string detail;
};

/// Of each axis, millimeters per minute; 0 is none.
struct MaximumFeed {
  double x = 0;
  double z = 0;
};

/// The last stage before the sink: stops a move that leaves the software limits (401, 403) or
/// enters the safe zone (413), before it is made. The whole path is checked. Positions are those of
/// events, without tool lengths. A feed per minute that an axis cannot follow is reduced.
class TravelGuard final : public EventFilter {
 public:
  explicit TravelGuard(EventSink& sink) : EventFilter(sink) {}

  /// Inactive, it passes everything; call `place` before it becomes active again.
  void set_active(bool active) { is_active_ = active; }
  /// An axis whose minimum is not below its maximum is not limited.
  void set_limits(const TravelArea& limits) { limits_ = limits; }
  /// Of the texts of faults.
  void set_units(Units units) { units_ = units; }
  void set_maximum_feed(const MaximumFeed& maximum) { max_ = maximum; }
  void set_zone(const std::optional<TravelArea>& zone) { zone_ = zone; }
  bool has_zone() const { return zone_.has_value(); }
  /// The machine's position, where the next move begins.
  void place(const Position& at);
  /// After a fault only alarms pass.
  const std::optional<TravelFault>& fault() const { return fault_; }
  void reset() { fault_.reset(); }
  /// Of a straight move that is not made; the machine is at `from`.
  std::optional<TravelFault> fault_on_line(const Position& from, const Position& to);

  /// Before a probe move, which may end anywhere on its path: whether all of it is allowed. Reduces
  /// its feed.
  bool allows(Probe& probe);

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;
  void on_probe(const Probe& event) override;

 private:
  struct Spot {
    double x = 0, z = 0;
  };
  static Spot spot_of(const Position& position);
  bool allows_line(const Origin& origin, const Position& to);
  bool allows_arc(const Arc& arc);
  bool is_within_limits(const Origin& origin, const Spot& at);
  bool crosses_zone(const Spot& to) const;
  bool is_in_zone(const Spot& at) const;
  bool arc_crosses_zone(const Arc& arc) const;
  Feed followed(Feed feed, double maximum) const;
  double max_on_line(const Position& to) const;
  double max_on_arc() const;
  bool refuse(ErrorCode code, const Origin& origin, std::string detail);

  std::string place_text(const Spot& at) const;

  bool is_active_ = false;
  Units units_ = Units::Inch;
  TravelArea limits_;
  std::optional<TravelArea> zone_;
  MaximumFeed max_;
  Spot at_;
  std::optional<TravelFault> fault_;
};

}  // namespace dripline::interpreter::centurion
