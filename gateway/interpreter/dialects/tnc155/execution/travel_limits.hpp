#pragma once

#include <optional>

#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter::tnc155 {

/// A move would lead beyond the limits set by hand.
struct LimitReached {
  Axis axis = Axis::X;
  bool is_positive = false;
  Origin origin;  ///< of the move
};

/// The last stage before the sink: the limits of MOD function LIMIT, for the
/// compensated path of the tool, including arcs between their ends. A move that leaves them is
/// not output, and after it only the alarm is.
class TravelLimits final : public EventGate {
 public:
  /// `low`, `high`: machine coordinates of the axes that are marked. The sink must outlive it.
  TravelLimits(EventSink& out, const Position& low, const Position& high);

  bool has_any() const { return has_any_; }
  const std::optional<LimitReached>& reached() const { return reached_; }
  /// The machine is there.
  void place(const Position& at) { at_ = at; }
  void reset() { reached_.reset(); }

  /// Checks of moves that are not made yet. Only axes that move are checked on a line.
  void check_line(const Origin& origin, const Position& from, const Position& to);
  void check_arc(const Arc& arc, const Position& from);

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_probe(const Probe& event) override;
  void on_alarm(const Alarm& event) override { out().on_alarm(event); }

 private:
  bool is_open() const override { return !reached_; }
  void check(const Origin& origin, Axis axis, double value);
  template <class Event>
  void follow(void (EventSink::*deliver)(const Event&), const Event& event, const Position& to);

  const Position low_, high_;
  bool has_any_;
  Position at_;
  std::optional<LimitReached> reached_;
};

}  // namespace dripline::interpreter::tnc155
