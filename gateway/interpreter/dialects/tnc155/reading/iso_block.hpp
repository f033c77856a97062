#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "gateway/interpreter/dialects/tnc155/errors.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_parts.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/reading_state.hpp"

namespace dripline::interpreter::tnc155 {

/// The words of an ISO block for lengths and angles, in the order in which the control sorts them.
enum class IsoSlot : std::uint8_t { I, J, K, X, Y, Z, A, B, C, U, V, W, R, H };
inline constexpr std::size_t kIsoSlots = 14;

/// How such a word is measured: by a G90 or G91 in front of it (or of a word before it), or by the
/// modal function in force at the start of the block.
enum class Distance : std::uint8_t { AsBefore, Absolute, Incremental };

/// G codes of one group exclude each other in a block.
enum class IsoGroup : std::uint8_t {
  Motion,        ///< 00-03, 05-07, 10-13, 15
  Plane,         ///< 17-20
  Compensation,  ///< 40-44
  Corner,        ///< 24-27
  Cycle,         ///< 04, 28, 39, 54, 72-78, 83, 84
  Call,          ///< 79
  Pole,          ///< 29
  Blank,         ///< 30, 31
  Stop,          ///< 38
  Tool,          ///< 51, 99
  Probe,         ///< 55
  Unit,          ///< 70, 71
  Protection,    ///< 50
  Label,         ///< 98
};
inline constexpr std::size_t kIsoGroups = 14;

/// P and its two digits.
struct IsoParameter {
  Value value;
  std::optional<Axis> axis;
  std::optional<ProbeDirection> direction;
  friend bool operator==(const IsoParameter&, const IsoParameter&) = default;
};

/// The words of one ISO block, enough to write it again. Its effect depends on the blocks before
/// it: see `resolve`.
struct IsoBlock {
  static constexpr std::int32_t kNone = -1;

  bool has(IsoGroup group) const { return (groups >> static_cast<unsigned>(group) & 1u) != 0; }
  /// The number of the group's G code; only where `has`.
  std::uint8_t code(IsoGroup group) const { return codes[static_cast<std::size_t>(group)]; }
  bool has_code(IsoGroup group, int g) const { return has(group) && code(group) == g; }
  void set(IsoGroup group, std::uint8_t g) {
    groups = static_cast<std::uint16_t>(groups | 1u << static_cast<unsigned>(group));
    codes[static_cast<std::size_t>(group)] = g;
  }
  bool has(IsoSlot slot) const { return (slots >> static_cast<unsigned>(slot) & 1u) != 0; }
  const Value& value(IsoSlot slot) const { return values[static_cast<std::size_t>(slot)]; }
  Distance distance(IsoSlot slot) const { return distances[static_cast<std::size_t>(slot)]; }
  /// The place of the slot's value, which is still to be put there.
  Value& add(IsoSlot slot, Distance distance) {
    slots = static_cast<std::uint16_t>(slots | 1u << static_cast<unsigned>(slot));
    distances[static_cast<std::size_t>(slot)] = distance;
    return values[static_cast<std::size_t>(slot)];
  }
  void set(IsoSlot slot, Value value, Distance distance) { add(slot, distance) = value; }
  bool has_parameter(std::size_t p) const { return (parameters >> p & 1u) != 0; }

  std::int32_t number = kNone;  ///< N
  std::uint16_t groups = 0;     ///< bits of IsoGroup
  std::uint16_t slots = 0;      ///< bits of IsoSlot
  std::uint8_t parameters = 0;  ///< bits of P01-P07, the number being the bit
  std::int8_t m = kNone;
  std::int8_t function = kNone;  ///< D
  /// A G90 or G91 that no word of the block follows; AsBefore: none.
  Distance last_distance = Distance::AsBefore;
  Distance written_distance = Distance::AsBefore;  ///< the last G90 or G91 of the text
  std::int32_t tool = kNone;                       ///< T
  std::int32_t label = kNone;                      ///< L after G98 (set), else a call
  std::int32_t repeats = kNone;                    ///< L15.8
  std::int32_t program = kNone;                    ///< %
  std::int32_t parameter = kNone;                  ///< Q of a D function
  std::int32_t called_program = kNone;             ///< P01 of G39
  std::int32_t factor = kNone;                     ///< F of G72, millionths
  Value length;                                    ///< L after G99
  Value feed;                                      ///< F; of G04 seconds
  Value spindle;                                   ///< S
  std::array<std::uint8_t, kIsoGroups> codes;      ///< where `groups` has the bit
  std::array<Distance, kIsoSlots> distances;       ///< where `slots` has the bit
  std::array<Value, kIsoSlots> values;
  std::array<IsoParameter, 8> cycle;  ///< P01-P07, where `parameters` has the bit
};

/// Reads one ISO block, [begin, end) without its `*`; `*end` is readable and is a `*` or a line
/// end. False: `fault` has the reason.
bool read_iso_block(const char* begin, const char* end, const ProgramForm& form, IsoBlock& block,
                    Fault& fault);

/// Resolves the block into parts under the modal `state`, in the order of execution, and updates
/// `state`. `is_first`: the program begins with the block. False: `fault` has the reason, and
/// `state` is unchanged.
bool resolve(const IsoBlock& block, bool is_first, ReadingState& state, BlockParts& parts,
             Fault& fault);

/// Resolves the blocks whose words must be alone in their block: %, D functions, label calls.
/// Arguments and result as of `resolve`.
bool resolve_alone(const IsoBlock& block, bool is_first, ProgramForm& program, BlockParts& parts,
                   Fault& fault);

inline constexpr std::array kAxisSlotList{IsoSlot::X, IsoSlot::Y, IsoSlot::Z,
                                          IsoSlot::A, IsoSlot::B, IsoSlot::C,
                                          IsoSlot::U, IsoSlot::V, IsoSlot::W};
inline constexpr unsigned kAxisSlots = 0x0FF8;
inline constexpr unsigned kCenterSlots = 0x0007;
inline constexpr unsigned kRadiusSlot = 1u << static_cast<unsigned>(IsoSlot::R);
inline constexpr unsigned kAngleSlot = 1u << static_cast<unsigned>(IsoSlot::H);

/// The words of a block to which G90 and G91 apply. The radius of a corner or a tool and the axes
/// of a mirror are not coordinates; a MIN corner (G30) is always absolute (manual: graphics, BLK
/// FORM).
inline unsigned distance_slots(const IsoBlock& block) {
  unsigned slots = block.slots;
  if (block.has(IsoGroup::Corner) || block.has(IsoGroup::Tool)) slots &= ~kRadiusSlot;
  if (block.has_code(IsoGroup::Cycle, 28) || block.has_code(IsoGroup::Blank, 30)) {
    slots &= ~kAxisSlots;
  }
  return slots;
}

/// Slots from X to W are in the order of `Axis`.
constexpr Axis axis_of_slot(IsoSlot slot) {
  return static_cast<Axis>(static_cast<unsigned>(slot) - static_cast<unsigned>(IsoSlot::X));
}
constexpr IsoSlot slot_of_axis(Axis axis) {
  return static_cast<IsoSlot>(static_cast<unsigned>(axis) + static_cast<unsigned>(IsoSlot::X));
}
/// The spindle axis of G17-G19; none of G20.
constexpr std::optional<Axis> axis_of_plane(int code) {
  if (code == 17) return Axis::Z;
  if (code == 18) return Axis::Y;
  if (code == 19) return Axis::X;
  return std::nullopt;
}
/// The inverse; only X, Y and Z have a plane function.
constexpr std::optional<std::uint8_t> plane_of_axis(Axis axis) {
  if (axis == Axis::Z) return std::uint8_t{17};
  if (axis == Axis::Y) return std::uint8_t{18};
  if (axis == Axis::X) return std::uint8_t{19};
  return std::nullopt;
}

// Words put into an ISO block, as the conversion from plain language does.

inline Value whole(std::int32_t number) {
  return Value::steps(number * Value::kStepsPerUnit);
}

inline void set_slot(IsoBlock& iso, IsoSlot slot, const Value& value, bool is_incremental) {
  iso.set(slot, value, is_incremental ? Distance::Incremental : Distance::Absolute);
}

inline void set_coordinates(IsoBlock& iso, const Block& block) {
  for (const Coordinate& coordinate : block.words()) {
    set_slot(iso, slot_of_axis(coordinate.axis), coordinate.value, coordinate.is_incremental);
  }
}

inline void set_parameter(IsoBlock& iso, std::size_t number, const IsoParameter& parameter) {
  iso.parameters = static_cast<std::uint8_t>(iso.parameters | 1u << number);
  iso.cycle[number] = parameter;
}

inline constexpr std::uint8_t kIllegalCode = 0xFF;
inline constexpr std::uint8_t kDistanceCode = 0xFE;  ///< 90, 91

/// The group of each G code.
inline constexpr std::array<std::uint8_t, 100> kGroupsOfCodes = [] {
  std::array<std::uint8_t, 100> groups{};
  groups.fill(kIllegalCode);
  const auto put = [&](std::uint8_t group, auto... codes) {
    ((groups[std::size_t{codes}] = group), ...);
  };
  const auto add = [&](IsoGroup group, auto... codes) {
    put(static_cast<std::uint8_t>(group), codes...);
  };
  add(IsoGroup::Motion, 0u, 1u, 2u, 3u, 5u, 6u, 7u, 10u, 11u, 12u, 13u, 15u);
  add(IsoGroup::Plane, 17u, 18u, 19u, 20u);
  add(IsoGroup::Compensation, 40u, 41u, 42u, 43u, 44u);
  add(IsoGroup::Corner, 24u, 25u, 26u, 27u);
  add(IsoGroup::Cycle, 4u, 28u, 39u, 54u, 72u, 73u, 74u, 75u, 76u, 77u, 78u, 83u, 84u);
  add(IsoGroup::Call, 79u);
  add(IsoGroup::Pole, 29u);
  add(IsoGroup::Blank, 30u, 31u);
  add(IsoGroup::Stop, 38u);
  add(IsoGroup::Tool, 51u, 99u);
  add(IsoGroup::Probe, 55u);
  add(IsoGroup::Unit, 70u, 71u);
  add(IsoGroup::Protection, 50u);
  add(IsoGroup::Label, 98u);
  put(kDistanceCode, 90u, 91u);
  return groups;
}();

}  // namespace dripline::interpreter::tnc155
