#include "gateway/app/memory/position_change.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dripline::gateway {

using interpreter::CellNumber;
using interpreter::CellUnit;
using interpreter::PositionSetting;
using nlohmann::json;

namespace {

/// What the new number was computed with, in its unit.
struct Basis {
  CellUnit unit{};
  std::optional<double> length = {};  ///< of the tool in force; none: the axis has no lengths
  std::optional<double> zero = {};    ///< of the work offset; none: it is what was set
};

Basis basis_of(const PositionToShow& shown) {
  const PositionSetting& setting = shown.setting;
  const CellNumber& cell = shown.changes.front();
  const double unit = cell.unit == CellUnit::Inch ? Length::kMillimetersPerInch : 1;
  Basis basis{.unit = cell.unit};
  const auto axis = static_cast<std::size_t>(setting.axis);
  if (shown.place.has_lengths && axis < shown.place.length.size())
    basis.length = shown.place.length[axis] / unit;
  if (setting.tool == 0) return basis;
  const double value = setting.canonical() / (shown.is_diameter ? 2 : 1);
  const double at = shown.place.at[axis] + shown.place.length_of(setting.axis);
  basis.zero = (at - value) / unit - cell.value;
  return basis;
}

/// " (tool's length in force: X 10.000 mm; G54: 2.000 mm)"
std::string text_of(const Basis& basis, const PositionSetting& setting) {
  const std::string_view unit = to_text(basis.unit);
  std::string text;
  if (basis.length) {
    const bool is_none = std::fabs(*basis.length) < 1e-9;
    const char letter = interpreter::letter(setting.axis);
    text = is_none ? fmt::format("no tool's length in force along {}", letter)
                   : fmt::format("tool's length in force: {} {} {}", letter,
                                 shown_number(basis.length, basis.unit), unit);
  }
  if (basis.zero) {
    text += fmt::format("{}{}: {} {}", text.empty() ? "" : "; ", setting.offset,
                        shown_number(basis.zero, basis.unit), unit);
  }
  return text.empty() ? text : " (" + text + ")";
}

/// A mill's wear stays when the length is measured, and is added to it; empty: there is none.
std::string wear_left(const PositionToShow& shown) {
  if (shown.setting.tool == 0) return {};
  const std::string name = shown.changes.front().name + "_wear";
  if (std::ranges::find(shown.changes, name, &CellNumber::name) != shown.changes.end()) return {};
  const auto wear = shown.before(name);
  if (!wear || !std::isfinite(*wear) || std::fabs(*wear) < 1e-9) return {};
  const CellUnit unit = shown.changes.front().unit;
  return fmt::format("; {} stays, {} {}: the length in force will be the sum", name,
                     shown_number(wear, unit), to_text(unit));
}

json number_json(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? json(*number) : json(nullptr);
}

}  // namespace

PositionChange shown_change(const PositionToShow& shown) {
  const Basis basis = basis_of(shown);
  PositionChange change;
  json cells = json::array(), numbers = json::object();
  for (const CellNumber& cell : shown.changes) {
    const auto before = shown.before(cell.name);
    change.text += fmt::format("{}{} is {} {}, it was {}", change.text.empty() ? "" : "; ",
                               cell.name, shown_number(cell.value, cell.unit), to_text(cell.unit),
                               shown_number(before, cell.unit));
    numbers[cell.name] = {number_json(before), cell.value};
    cells.push_back({{"name", cell.name},
                     {"before", number_json(before)},
                     {"value", cell.value},
                     {"unit", to_text(cell.unit)}});
  }
  change.text += wear_left(shown) + text_of(basis, shown.setting);
  const json length = number_json(basis.length), zero = number_json(basis.zero);
  change.details = json{{"cells", std::move(cells)}, {"length", length}, {"zero", zero}}.dump();
  const double at = shown.place.at[static_cast<std::size_t>(shown.setting.axis)];
  change.record = json{{"what", to_text(shown.setting)},
                       {"by", shown.who},
                       {"at", at * (shown.is_diameter ? 2 : 1)},
                       {"unit", to_text(basis.unit)},
                       {"length", length},
                       {"zero", zero},
                       {"cells", std::move(numbers)}}
                      .dump();
  return change;
}

}  // namespace dripline::gateway
