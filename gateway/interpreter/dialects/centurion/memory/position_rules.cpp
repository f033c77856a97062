#include "gateway/interpreter/core/positions.hpp"

#include <array>

#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"

// The handwheel screen (manual: handwheel): G5#-Z sets the Z zero of a work offset, XTOOL and ZTOOL
// store a tool's length and clear its wear; the position of XTOOL is a diameter.

namespace dripline::interpreter {
namespace {

using centurion::Parameters;
using centurion::ToolField;

constexpr std::array<std::string_view, 6> kOffsets{"G54", "G55", "G56", "G57", "G58", "G59"};
constexpr double kMaxLength = 9999.9999;  // inches, as an axis word

std::string parameter(int number) {
  return fmt::format("P{}", number);
}

Result<std::vector<CellNumber>> changes(const PositionSetting& setting, const RestingPlace& place,
                                        const ReadCell& read) {
  const auto found = std::find(kOffsets.begin(), kOffsets.end(), setting.offset);
  if (found == kOffsets.end())
    return fail(Errc::NotFound, "this control has no work offset '{}': G54 to G59", setting.offset);
  const bool is_x = setting.axis == Axis::X;
  const int system = static_cast<int>(found - kOffsets.begin());
  const std::string zero = parameter(centurion::kWorkOffsets + 2 * system + (is_x ? 1 : 0));
  const double unit = place.memory == Units::Inch ? Length::kMillimetersPerInch : 1;
  const double at = place.at[static_cast<std::size_t>(setting.axis)] / unit;
  const double most = kMaxLength * (place.memory == Units::Inch ? 1 : Length::kMillimetersPerInch);
  if (setting.tool == 0) {
    if (auto fits = check_size(at, most, zero); !fits) return fail(fits.error());
    return std::vector{CellNumber{zero, at, unit_of(setting.axis, place.memory)}};
  }
  if (setting.tool > centurion::kOffsetCount) {
    return fail(Errc::NotFound, "this control has no tool offset {}: 1 to {}", setting.tool,
                centurion::kOffsetCount);
  }
  const auto of_zero = number_of(read, zero, zero);
  if (!of_zero) return fail(of_zero.error());
  const double value = setting.canonical() / unit / (is_x ? 2 : 1);
  const double in_force = place.length_of(setting.axis) / unit;
  const double length = at + in_force - *of_zero - value;
  const std::string cell = parameter(
      Parameters::tool_parameter(setting.tool, is_x ? ToolField::LengthX : ToolField::LengthZ));
  if (auto fits = check_size(length, most, cell); !fits) return fail(fits.error());
  const int wear =
      Parameters::tool_parameter(setting.tool, is_x ? ToolField::WearX : ToolField::WearZ);
  const CellUnit shown = unit_of(setting.axis, place.memory);
  return std::vector{CellNumber{cell, length, shown}, CellNumber{parameter(wear), 0, shown}};
}

}  // namespace

const PositionRules kCenturionPosition{.offsets = kOffsets,
                                       .datum_axes = "Z",
                                       .tool_axes = "XZ",
                                       .is_zero_only = true,
                                       .changes = &changes};

}  // namespace dripline::interpreter
