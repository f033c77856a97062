#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "gateway/interpreter/dialects/tnc155/errors.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"
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
  std::int32_t tool = kNone;                   ///< T
  std::int32_t label = kNone;                  ///< L after G98 (set), else a call
  std::int32_t repeats = kNone;                ///< L15.8
  std::int32_t program = kNone;                ///< %
  std::int32_t parameter = kNone;              ///< Q of a D function
  std::int32_t called_program = kNone;         ///< P01 of G39
  std::int32_t factor = kNone;                 ///< F of G72, millionths
  Value length;                                ///< L after G99
  Value feed;                                  ///< F; of G04 seconds
  Value spindle;                               ///< S
  std::array<std::uint8_t, kIsoGroups> codes;  ///< where `groups` has the bit
  std::array<Distance, kIsoSlots> distances;   ///< where `slots` has the bit
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

}  // namespace dripline::interpreter::tnc155
