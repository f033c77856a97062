#pragma once

#include <functional>

#include "gateway/interpreter/stages/event_filter.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::machine {

/// Between the interpreter and a back end: an event that the back end cannot execute becomes an
/// alarm (MCH0008) in its place, so that everything before it is still executed and nothing after
/// it is. Capabilities and sink must outlive it.
class CapabilityFilter final : public interpreter::EventFilter {
 public:
  /// Of the interpreter whose events these are, at the moment of an event.
  using Modes = std::function<interpreter::ActiveModes()>;
  CapabilityFilter(const MotionCapabilities& capabilities, interpreter::EventSink& to, Modes modes)
      : EventFilter(to), capabilities_(capabilities), modes_(std::move(modes)) {}

  void on_rapid(const interpreter::Rapid& rapid) override;
  void on_line(const interpreter::Line& line) override;
  void on_arc(const interpreter::Arc& arc) override;
  void on_thread(const interpreter::Thread& thread) override;
  void on_dwell(const interpreter::Dwell& dwell) override;

  /// False: an alarm. The positions of events leave a tool's length out, so a machine that takes
  /// none into account would move deeper by it.
  bool takes_length(const interpreter::Origin& origin);
  /// The alarm of a missing capability, for what is asked of the owner instead (a probe).
  void refuse(const interpreter::Origin& origin, std::string_view what);

 private:
  bool has_feed(const interpreter::Origin& origin, Feed feed);

  const MotionCapabilities& capabilities_;
  const Modes modes_;
};

}  // namespace dripline::machine
