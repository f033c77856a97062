#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

/// The values the control accepts. Lengths of inch programs span the same travel; degrees are the
/// same in both.
namespace dripline::interpreter::tnc155 {

inline constexpr std::int64_t kUnit = Value::kStepsPerUnit;

inline constexpr Range kMetricCoordinate{-30'000 * kUnit, 30'000 * kUnit};
inline constexpr Range kInchCoordinate{-11'811'024, 11'811'024};
inline constexpr Range kMetricRadius{0, 20'000 * kUnit - 10};
inline constexpr Range kInchRadius{0, 7'874'015};
inline constexpr Range kRotaryCoordinate{-30'000 * kUnit, 30'000 * kUnit, false, true, true};
inline constexpr Range kAbsoluteAngle{-360 * kUnit, 360 * kUnit, false, true, true};
inline constexpr Range kIncrementalAngle{-5'400 * kUnit, 5'400 * kUnit, false, true, true};
inline constexpr Range kMetricFeed{0, 15'999 * kUnit, true};
inline constexpr Range kInchFeed{0, 6'299 * kUnit, true};
inline constexpr Range kSpindleSpeed{0, 30'000 * kUnit, false, false};
inline constexpr Range kSeconds{0, 20'000 * kUnit - 10};
inline constexpr Range kOperand{-100'000 * kUnit + 1, 100'000 * kUnit - 1};
inline constexpr std::int32_t kMaxScale = 99'999'999;  ///< millionths
inline constexpr std::int32_t kMaxProgram = 99'999'999;
inline constexpr std::int32_t kMaxTool = 254;
inline constexpr std::int32_t kMaxLabel = 254;
inline constexpr std::int32_t kMaxRepeats = 65'535;
inline constexpr std::int32_t kMaxBlockNumber = 65'534;

inline const Range& coordinate_range(const ProgramForm& form) {
  return form.units == Units::Inch ? kInchCoordinate : kMetricCoordinate;
}
inline const Range& coordinate_range(const ProgramForm& form, Axis axis) {
  return is_rotary(axis) ? kRotaryCoordinate : coordinate_range(form);
}
inline const Range& radius_range(const ProgramForm& form) {
  return form.units == Units::Inch ? kInchRadius : kMetricRadius;
}
inline const Range& feed_range(const ProgramForm& form) {
  return form.units == Units::Inch ? kInchFeed : kMetricFeed;
}
inline const Range& angle_range(bool is_incremental) {
  return is_incremental ? kIncrementalAngle : kAbsoluteAngle;
}

/// The axis of a letter for which `is_axis_letter` holds.
inline Axis axis_of_letter(char c) {
  if (c >= 'X') return static_cast<Axis>(c - 'X');
  if (c >= 'U') return static_cast<Axis>(static_cast<int>(Axis::U) + (c - 'U'));
  return static_cast<Axis>(static_cast<int>(Axis::A) + (c - 'A'));
}

}  // namespace dripline::interpreter::tnc155
