#pragma once

#include <array>
#include <cstdint>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::interpreter::tnc155 {

/// A complete definition of a machining cycle (1-5, 12). Lengths are millimeters with
/// their signs, feeds millimeters per minute, dwells seconds.
struct MachiningCycle {
  std::uint16_t number = 0;  ///< 0: none was defined
  double clearance = 0;      ///< set-up
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

/// The state that cycle definitions leave for calls and later blocks.
struct CycleState {
  bool is_modal_call = false;  ///< M89
  std::uint16_t defining = 0;  ///< cycle whose sub-blocks come now
  std::uint8_t next_part = 0;  ///< which one comes next
  bool is_complete = true;     ///< no sub-block is missing
  std::uint64_t block = 0;     ///< of the run: the last sub-block
  MachiningCycle machining;    ///< what a call runs
  MachiningCycle draft;        ///< the definition so far
  ProbeState probe;
};

}  // namespace dripline::interpreter::tnc155
