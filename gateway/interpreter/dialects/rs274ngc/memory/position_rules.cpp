#include "gateway/interpreter/core/positions.hpp"

#include <array>

#include "gateway/interpreter/dialects/rs274ngc/memory/parameters.hpp"

// Touch off of LinuxCNC's screens: G10 L20 for a work offset, G10 L10 for the tool table.

namespace dripline::interpreter {
namespace {

using namespace rs274ngc;

constexpr std::array<std::string_view, 9> kOffsets{"G54", "G55",   "G56",   "G57",  "G58",
                                                   "G59", "G59.1", "G59.2", "G59.3"};
constexpr double kMaxLength = 1e6;  // mm: LinuxCNC has no limit of its own

Result<std::vector<CellNumber>> changes(const PositionSetting& setting, const RestingPlace& place,
                                        const ReadCell& read) {
  const auto found = std::find(kOffsets.begin(), kOffsets.end(), setting.offset);
  if (found == kOffsets.end()) {
    return fail(Errc::NotFound, "this control has no work offset '{}': G54 to G59.3",
                setting.offset);
  }
  const int first = first_of_system(static_cast<int>(found - kOffsets.begin()) + 1);
  const auto axis = static_cast<int>(setting.axis);
  const auto parameter = [](int number) { return fmt::format("#{}", number); };
  const bool is_rotated = setting.axis == Axis::X || setting.axis == Axis::Y;
  if (is_rotated && read(parameter(first + kSystemRotation)).value_or(0) != 0) {
    return fail(Errc::Unsupported,
                "{} is rotated (#{}): an offset of X or Y alone cannot be set from the position",
                setting.offset, first + kSystemRotation);
  }
  const bool is_inch = place.memory == Units::Inch && !is_rotary(setting.axis);
  const double unit = is_inch ? Length::kMillimetersPerInch : 1;
  const auto work = number_of(read, parameter(first + axis), setting.offset);
  if (!work) return fail(work.error());
  const double at = place.at[static_cast<std::size_t>(axis)];
  const bool is_shifted = read(parameter(kG92Active)).value_or(0) != 0;
  const double shift = is_shifted ? read(parameter(kG92Offsets + axis)).value_or(0) * unit : 0;
  if (setting.tool == 0) {
    const double datum = at - setting.canonical() - shift;
    if (auto fits = check_size(datum, kMaxLength, setting.offset); !fits) return fail(fits.error());
    return std::vector{
        CellNumber{parameter(first + axis), datum / unit, unit_of(setting.axis, place.memory)}};
  }
  const std::string cell = fmt::format("tool.{}.{}", setting.tool, letter(setting.axis));
  const auto known = number_of(
      read, cell, fmt::format("tool {} in its tool table: add it to the setup", setting.tool));
  if (!known) return fail(known.error());
  const double length =
      at + place.length_of(setting.axis) - *work * unit - shift - setting.canonical();
  if (auto fits = check_size(length, kMaxLength, cell); !fits) return fail(fits.error());
  return std::vector{CellNumber{cell, length}};
}

}  // namespace

const PositionRules kRs274NgcPosition{
    .offsets = kOffsets, .datum_axes = "XYZABCUVW", .tool_axes = "XZ", .changes = &changes};

}  // namespace dripline::interpreter
