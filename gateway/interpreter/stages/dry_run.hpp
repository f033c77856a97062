#pragma once

#include "gateway/interpreter/core/path_feed.hpp"
#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter {

/// The DRY key (manual: DRY): every feed, and every thread, becomes a feed at the Dry Run Feed,
/// which is that of all axes together, degrees as millimeters; the spindle stays off unless the
/// machine is set up otherwise.
class DryRun final : public EventFilter {
 public:
  /// `start` is where the program begins.
  DryRun(EventSink& out, Feed feed, bool turns_spindle, const Position& start = {})
      : EventFilter(out), feed_(feed), turns_spindle_(turns_spindle), at_(start) {}

  void on_rapid(const Rapid& event) override {
    at_ = event.to;
    out().on_rapid(event);
  }
  void on_line(const Line& event) override {
    Line line = event;
    line.feed = feed_of_all_axes(feed_, travel_between(at_, event.to), Length::mm(1));
    at_ = event.to;
    out().on_line(line);
  }
  void on_arc(const Arc& event) override {
    Arc arc = event;
    arc.feed = feed_;
    at_ = event.to;
    out().on_arc(arc);
  }
  void on_thread(const Thread& event) override {
    if (event.arc) return DryRun::on_arc(arc_of(event));
    Line line;
    line.origin = event.origin;
    line.to = event.to;
    DryRun::on_line(line);
  }
  void on_probe(const Probe& event) override {
    if (event.result) at_ = event.result->at;
    out().on_probe(event);
  }
  void on_spindle(const Spindle& event) override {
    if (turns_spindle_ || event.state == SpindleState::Off) out().on_spindle(event);
  }

 private:
  Feed feed_;
  bool turns_spindle_;
  Position at_;
};

}  // namespace dripline::interpreter
