#include "gateway/interpreter/core/positions.hpp"

// DATUM SET of the manual operating mode, and the actual position key of programming (manual:
// setting the workpiece datum; programming by playback). Tools are measured by the same key: L of
// TOOL DEF is text of a program, not memory.

namespace dripline::interpreter {
namespace {

constexpr double kMaxPosition = 30000;  // mm and degrees, as the control takes positions

Result<std::vector<CellNumber>> changes(const PositionSetting& setting, const RestingPlace& place,
                                        const ReadCell& read) {
  if (!setting.offset.empty())
    return fail(Errc::NotFound, "this control has one datum, and no '{}'", setting.offset);
  const std::string cell = fmt::format("datum.{}", letter(setting.axis));
  const auto known = number_of(read, cell, cell);
  if (!known) return fail(known.error());
  const double value = setting.canonical();
  if (auto fits = check_size(value, kMaxPosition, "the coordinate"); !fits)
    return fail(fits.error());
  return std::vector{CellNumber{cell, place.at[static_cast<std::size_t>(setting.axis)] - value,
                                unit_of(setting.axis)}};
}

/// One axis: a single-axis block; more: a straight line. The operator adds feed and M.
std::string playback(const std::array<double, kAxisCount>& at, std::span<const Axis> axes) {
  std::string text = axes.size() > 1 ? "L" : "";
  for (const Axis axis : axes) {
    if (!text.empty()) text += ' ';
    double value = std::round(at[static_cast<std::size_t>(axis)] * 1000) / 1000;
    if (value == 0) value = 0;  // not -0
    text += fmt::format("{}{:+.3f}", letter(axis), value);
  }
  return text + " R0";
}

}  // namespace

const PositionRules kTncPosition{
    .datum_axes = "XYZABCUVW", .changes = &changes, .playback = &playback};

}  // namespace dripline::interpreter
