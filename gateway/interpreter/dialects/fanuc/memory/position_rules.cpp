#include "gateway/interpreter/core/positions.hpp"

#include <array>

#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"

// [MEASUR] of the work offset and the geometry offset screens (16/18 operator's manual, setting and
// displaying data). On a lathe the wear of the measured axis becomes 0; a mill's stays.

namespace dripline::interpreter {
namespace {

constexpr double kMaxWorkOffset = 99999.999;  // mm, as an axis word
constexpr std::array<std::string_view, 6> kOffsets{"G54", "G55", "G56", "G57", "G58", "G59"};

/// Of the work offset and EXT together, mm.
Result<double> zero_of(const PositionSetting& setting, const ReadCell& read) {
  const std::string suffix = fmt::format(".{}", letter(setting.axis));
  const bool is_work = setting.offset.starts_with("G5");
  const auto work = number_of(
      is_work ? read : ReadCell([](const auto&) { return std::nullopt; }), setting.offset + suffix,
      fmt::format("work offset '{}': G54 to G59, or G54.1P1 and up", setting.offset));
  if (!work) return work;
  return *work + read("EXT" + suffix).value_or(0);
}

Result<std::vector<CellNumber>> measured(const PositionSetting& setting, const RestingPlace& place,
                                         const ReadCell& read, bool is_lathe) {
  const auto zero = zero_of(setting, read);
  if (!zero) return fail(zero.error());
  const bool is_diameter = is_lathe && setting.axis == Axis::X;
  const double value = setting.canonical() / (is_diameter ? 2 : 1);
  const double at = place.at[static_cast<std::size_t>(setting.axis)];
  const std::string suffix = fmt::format(".{}", letter(setting.axis));
  if (setting.tool == 0) {
    const std::string cell = setting.offset + suffix;
    const double datum = at - value - read("EXT" + suffix).value_or(0);
    if (auto fits = check_size(datum, kMaxWorkOffset, cell); !fits) return fail(fits.error());
    return std::vector{CellNumber{cell, datum, unit_of(setting.axis)}};
  }
  const bool is_x = setting.axis == Axis::X;
  const std::string tool = fmt::format("tool.{}.", setting.tool);
  const std::string cell = tool + (is_x ? "x" : "length");
  const auto known = number_of(read, cell, fmt::format("tool offset {}", setting.tool));
  if (!known) return fail(known.error());
  const double length = at + place.length_of(setting.axis) - *zero - value;
  if (auto fits = check_size(length, fanuc::kMaxOffsetValue, cell); !fits)
    return fail(fits.error());
  std::vector<CellNumber> changes{{cell, length}};
  if (is_lathe) changes.push_back({tool + (is_x ? "x_wear" : "length_wear"), 0});
  return changes;
}

Result<std::vector<CellNumber>> on_mill(const PositionSetting& setting, const RestingPlace& place,
                                        const ReadCell& read) {
  return measured(setting, place, read, false);
}
Result<std::vector<CellNumber>> on_lathe(const PositionSetting& setting, const RestingPlace& place,
                                         const ReadCell& read) {
  return measured(setting, place, read, true);
}

}  // namespace

const PositionRules kFanucPosition{
    .offsets = kOffsets, .datum_axes = "XYZABCUVW", .tool_axes = "Z", .changes = &on_mill};
const PositionRules kFanucLathePosition{
    .offsets = kOffsets, .datum_axes = "XZYC", .tool_axes = "XZ", .changes = &on_lathe};

}  // namespace dripline::interpreter
