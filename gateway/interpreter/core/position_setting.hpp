#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/result.hpp"

/// What an operator sets from where the axes of a machine at rest are: the datum of a work offset,
/// or a tool's length. Nothing moves; numbers in the control's memory change
/// (retained_memory.hpp).
namespace dripline::interpreter {

struct PositionSetting {
  int tool = 0;        ///< whose length is set; 0: the datum is
  std::string offset;  ///< the work offset, "G54"; empty where the control has one datum
  Axis axis = Axis::X;
  double value = 0;  ///< the coordinate that the present position gets; X of a lathe: a diameter
  Units units = Units::Millimeter;  ///< of `value`, where the axis is linear

  /// In millimeters or degrees.
  double canonical() const;
  friend bool operator==(const PositionSetting&, const PositionSetting&) = default;
};

/// "datum G54 X 12.5 mm", "tool 3 Z 0 in G54"
std::string to_text(const PositionSetting& setting);
/// Errors: Syntax.
Result<PositionSetting> parse_position_setting(std::string_view text);

struct RestingPlace {
  double length_of(Axis axis) const {
    const auto i = static_cast<std::size_t>(axis);
    return i < length.size() ? length[i] : 0;
  }

  /// In machine coordinates, the length of the tool left out; mm and degrees, X of a lathe a
  /// radius.
  std::array<double, kAxisCount> at{};
  /// Of the tool offset in force along X, Y and Z, mm: an axis is at `at` + `length`.
  std::array<double, 3> length{};
  bool has_lengths = true;           ///< false: of a machine that moves by none
  Units memory = Units::Millimeter;  ///< of the control's memory
};

/// The present number of a cell of the control's memory; nothing: it has none of that name.
using ReadCell = std::function<std::optional<double>(const std::string& name)>;
enum class CellUnit : std::uint8_t { Millimeter, Inch, Degree };
/// "mm", "in", "deg"
std::string_view to_text(CellUnit unit);
/// With the digits of a control's screen: "-170.000", "1.2500"; "vacant".
std::string shown_number(const std::optional<double>& value, CellUnit unit);
/// Of a cell of a linear axis in `memory`, or of a rotary one.
CellUnit unit_of(Axis axis, Units memory = Units::Millimeter);
struct CellNumber {
  std::string name;
  double value = 0;
  CellUnit unit = CellUnit::Millimeter;
};

/// Which of these functions a control has on its screen, and what they change.
struct PositionRules {
  /// Names of work offsets for a list; empty: there is one datum, without a name.
  std::span<const std::string_view> offsets = {};
  std::string_view datum_axes = {};  ///< letters; empty: no datum is set from the position
  std::string_view tool_axes = {};   ///< letters; empty: no length of a tool is
  bool is_zero_only = false;         ///< a datum's value is 0
  /// Errors: NotFound (no such offset or tool), LimitExceeded (beyond what the memory takes),
  /// Unsupported (something in the memory prevents it). The axis is one of those above.
  Result<std::vector<CellNumber>> (*changes)(const PositionSetting&, const RestingPlace&,
                                             const ReadCell&) = nullptr;
  /// The position (program coordinates, of these axes) as the words of a block that is being
  /// edited; nullptr: the control takes no position into a program.
  std::string (*playback)(const std::array<double, kAxisCount>& at,
                          std::span<const Axis> axes) = nullptr;
};

/// The number of a cell that a control has. Errors: NotFound, with `what`.
Result<double> number_of(const ReadCell& read, const std::string& cell, std::string_view what);
/// Errors: LimitExceeded.
Result<void> check_size(double value, double most, std::string_view what);

}  // namespace dripline::interpreter
