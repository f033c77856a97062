#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::interpreter::tnc155 {

/// A complete definition of a machining cycle (1-5, 12). Lengths are millimetres with
/// their signs, feeds millimetres per minute, dwells seconds.
struct MachiningCycle {
  std::uint8_t number = 0;  ///< 0: none was defined
  double clearance = 0;     ///< set-up
  double depth = 0;
  double peck = 0;
  double dwell = 0;
  double plunge_feed = 0;
  double feed = 0;
  Axis first_axis = Axis::X;  ///< of the first side
  Axis second_axis = Axis::Y;
  double first_side = 0;
  double second_side = 0;
  double radius = 0;  ///< of a circular pocket
  Turn turn = Turn::Counterclockwise;
  std::int32_t program = Block::kNone;  ///< cycle 12
};

/// The first half of TCH PROBE.
struct ProbeState {
  bool is_defined = false;
  std::int32_t q = 0;  ///< where the result goes
  Axis axis = Axis::Z;
  ProbeDirection direction = ProbeDirection::Negative;
};

/// The state that cycle definitions leave for calls and later blocks. Part of the run's state: add
/// new members to `visit_cycle_state` too.
struct CycleState {
  bool is_modal_call = false;  ///< M89
  std::uint8_t defining = 0;   ///< cycle whose sub-blocks come now
  std::uint8_t next_part = 0;  ///< which one comes next
  bool is_complete = true;     ///< no sub-block is missing
  std::uint64_t block = 0;     ///< of the run: the last sub-block
  MachiningCycle machining;    ///< what a call runs
  MachiningCycle draft;        ///< the definition so far
  ProbeState probe;
};

template <class Archive>
void visit_machining_cycle(Archive& archive, MachiningCycle& cycle) {
  archive(cycle.number);
  for (double* value :
       {&cycle.clearance, &cycle.depth, &cycle.peck, &cycle.dwell, &cycle.plunge_feed, &cycle.feed,
        &cycle.first_side, &cycle.second_side, &cycle.radius}) {
    archive(*value);
    if (!(*value >= -1e9 && *value <= 1e9)) archive.damage();
  }
  for (Axis* axis : {&cycle.first_axis, &cycle.second_axis}) {
    archive(*axis);
    if (static_cast<std::size_t>(*axis) >= kAxisCount) {
      archive.damage();
      *axis = Axis::X;
    }
  }
  bool is_clockwise = cycle.turn == Turn::Clockwise;
  archive(is_clockwise);
  cycle.turn = is_clockwise ? Turn::Clockwise : Turn::Counterclockwise;
  archive(cycle.program);
}

template <class Archive>
void visit_probe_state(Archive& archive, ProbeState& probe) {
  archive(probe.is_defined);
  archive(probe.q);
  archive(probe.axis);
  if (static_cast<std::size_t>(probe.axis) >= kAxisCount || probe.q < 0 || probe.q > 99) {
    archive.damage();
    probe = {};
  }
  bool is_positive = probe.direction == ProbeDirection::Positive;
  archive(is_positive);
  probe.direction = is_positive ? ProbeDirection::Positive : ProbeDirection::Negative;
}

template <class Archive>
void visit_cycle_state(Archive& archive, CycleState& cycle) {
  archive(cycle.is_modal_call);
  archive(cycle.defining);
  archive(cycle.next_part);
  archive(cycle.is_complete);
  archive(cycle.block);
  visit_machining_cycle(archive, cycle.machining);
  visit_machining_cycle(archive, cycle.draft);
  visit_probe_state(archive, cycle.probe);
}

}  // namespace dripline::interpreter::tnc155
