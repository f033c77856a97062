#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter {

enum class CompensationSide : std::uint8_t { Off, Left, Right };

/// The modes that a control shows with the block in hand and that no event carries: for the
/// display, not for a trace. Every dialect fills those it has; the rest keeps its default.
struct ActiveModes {
  Units units = Units::Millimeter;
  bool is_incremental = false;
  CompensationSide compensation = CompensationSide::Off;
  std::uint16_t work_system = 0;  ///< its code in tenths: 540 is G54; 0: the control has none
  std::uint16_t work_page = 0;    ///< the P of G54.1; 0: none
  Length tool_length_x;           ///< wear included, a radius
  Length tool_length_z;           ///< wear included
  Length tool_radius;
  Feed feed;                        ///< as programmed
  std::string_view cycle;           ///< static storage; empty: no cycle
  std::optional<Axis> tool_axis;    ///< the spindle's, where programs choose it
  std::uint32_t frame_changes = 0;  ///< another number: Interpreter::frame has changed
  friend bool operator==(const ActiveModes&, const ActiveModes&) = default;
};

/// The name of G73, G74, G76 and G81 to G89 on a mill; empty for any other code.
std::string_view hole_cycle_name(int g_code);

}  // namespace dripline::interpreter
