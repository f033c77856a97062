#pragma once

#include <functional>

#include "gateway/interpreter/stages/event_filter.hpp"
#include "gateway/machine/axis_lengths.hpp"
#include "gateway/machine/motion_backend.hpp"

namespace dripline::machine {

/// Between the interpreter and a back end: an event that the back end cannot execute becomes an
/// alarm (MCH0008) in its place, so that everything before it is still executed and nothing after
/// it is. A back end whose axes take lengths of tools in is told which. All references must outlive
/// it.
class CapabilityFilter final : public interpreter::EventFilter {
 public:
  /// Of the interpreter whose events these are, at the moment of an event.
  struct Now {
    interpreter::ActiveModes modes;
    std::uint64_t block = 0;  ///< being executed, or finished last
  };
  struct Lengths {
    bool shifts = false;                                    ///< Dialect::length_shifts_position
    bool is_certain = false;                                ///< Dialect::moves_with_length
    std::function<void(const ToolLengths&)> set = nullptr;  ///< MotionBackend::set_lengths
  };
  CapabilityFilter(const MotionCapabilities& capabilities, interpreter::EventSink& to,
                   std::function<Now()> now, Lengths lengths)
      : EventFilter(to),
        capabilities_(capabilities),
        now_(std::move(now)),
        rule_(std::move(lengths)),
        lengths_(rule_.shifts) {}

  void on_rapid(const interpreter::Rapid& rapid) override;
  void on_line(const interpreter::Line& line) override;
  void on_arc(const interpreter::Arc& arc) override;
  void on_thread(const interpreter::Thread& thread) override;
  void on_dwell(const interpreter::Dwell& dwell) override;
  void on_block_end(const interpreter::Origin& origin) override;

  /// The axes are at `at` + `lengths`, which the back end knows.
  void begin(const interpreter::Position& at, const ToolLengths& lengths) {
    lengths_.begin(at, lengths);
  }
  /// Call it after each block: the next one may change what a motion that still waits is for.
  /// False: an alarm.
  bool note_block(const interpreter::Origin& origin);
  /// For a probe, which the owner asks for. False: an alarm.
  bool takes_probe(const interpreter::Probe& probe);
  void note_probed(const interpreter::Position& at) { lengths_.note_position(at); }
  /// The alarm of a missing capability, for what is asked of the owner instead (a probe).
  void refuse(const interpreter::Origin& origin, std::string_view what);

 private:
  bool has_feed(const interpreter::Origin& origin, Feed feed);
  bool takes_motion(const interpreter::Origin& origin, const interpreter::Position& to,
                    bool is_arc = false);
  bool is_without_length(const interpreter::Origin& origin);
  bool is_certain(const interpreter::Origin& origin, const interpreter::ActiveModes& modes);
  bool adds_lengths() const { return capabilities_.adds_lengths && rule_.is_certain; }

  const MotionCapabilities& capabilities_;
  const std::function<Now()> now_;
  const Lengths rule_;
  AxisLengths lengths_;
};

}  // namespace dripline::machine
