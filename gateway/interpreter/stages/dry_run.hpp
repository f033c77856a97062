#pragma once

#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter {

/// The DRY key (manual: DRY): every feed, and every thread, becomes a feed at the Dry Run Feed; the
/// spindle stays off unless the machine is set up otherwise.
class DryRun final : public EventFilter {
 public:
  DryRun(EventSink& out, Feed feed, bool turns_spindle)
      : EventFilter(out), feed_(feed), turns_spindle_(turns_spindle) {}

  void on_line(const Line& event) override {
    Line line = event;
    line.feed = feed_;
    out().on_line(line);
  }
  void on_arc(const Arc& event) override {
    Arc arc = event;
    arc.feed = feed_;
    out().on_arc(arc);
  }
  void on_thread(const Thread& event) override {
    if (event.arc) {
      Arc arc = arc_of(event);
      arc.feed = feed_;
      return out().on_arc(arc);
    }
    Line line;
    line.origin = event.origin;
    line.to = event.to;
    line.feed = feed_;
    out().on_line(line);
  }
  void on_spindle(const Spindle& event) override {
    if (turns_spindle_ || event.state == SpindleState::Off) out().on_spindle(event);
  }

 private:
  Feed feed_;
  bool turns_spindle_;
};

}  // namespace dripline::interpreter
