#include "gateway/interpreter/core/position_setting.hpp"

#include <fmt/format.h>
#include <cmath>

#include "gateway/interpreter/core/operator_words.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter {
namespace {

/// As controls have them: G54, G54.1P7, G59.3.
bool is_offset_name(std::string_view name) {
  constexpr std::size_t kMax = 16;
  return name.size() <= kMax &&
         name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.") == std::string_view::npos;
}

}  // namespace

double PositionSetting::canonical() const {
  const bool is_inch = units == Units::Inch && !is_rotary(axis);
  return is_inch ? Length::inch(value).mm() : value;
}

std::string to_text(const PositionSetting& setting) {
  std::string text = setting.tool > 0 ? fmt::format("tool {}", setting.tool) : "datum";
  if (setting.tool == 0 && !setting.offset.empty()) text += " " + setting.offset;
  text += fmt::format(" {} {}", letter(setting.axis), setting.value);
  text += is_rotary(setting.axis) ? " deg" : setting.units == Units::Inch ? " in" : " mm";
  if (setting.tool > 0 && !setting.offset.empty()) text += " " + setting.offset;
  return text;
}

Result<PositionSetting> parse_position_setting(std::string_view text) {
  const std::string whole(text);
  const auto refuse = [&] {
    return fail(Errc::Syntax, "'{}': expected 'datum G54 X 12.5 mm' or 'tool 3 Z 0 mm G54'", whole);
  };
  PositionSetting setting;
  const std::string_view kind = take_word(text);
  if (kind == "tool") {
    if (!read_number(take_word(text), setting.tool) || setting.tool < 1) return refuse();
  } else if (kind != "datum") {
    return refuse();
  }
  std::string_view word = take_word(text);
  if (setting.tool == 0 && word.size() > 1) {
    setting.offset = word;
    word = take_word(text);
  }
  const auto axis = word.size() == 1 ? axis_of(word[0]) : std::nullopt;
  if (!axis || !read_number(take_word(text), setting.value) || !std::isfinite(setting.value))
    return refuse();
  setting.axis = *axis;
  const std::string_view unit = take_word(text);
  if (is_rotary(*axis) ? unit != "deg" : unit != "mm" && unit != "in") return refuse();
  if (unit == "in") setting.units = Units::Inch;
  if (setting.tool > 0) setting.offset = take_word(text);
  if (!text.empty() || !is_offset_name(setting.offset)) return refuse();
  return setting;
}

std::string_view to_text(CellUnit unit) {
  return unit == CellUnit::Degree ? "deg" : unit == CellUnit::Inch ? "in" : "mm";
}

std::string shown_number(const std::optional<double>& value, CellUnit unit) {
  if (!value || !std::isfinite(*value)) return "vacant";
  const int decimals = unit == CellUnit::Inch ? 4 : 3;
  const std::string text = fmt::format("{:.{}f}", *value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

CellUnit unit_of(Axis axis, Units memory) {
  if (is_rotary(axis)) return CellUnit::Degree;
  return memory == Units::Inch ? CellUnit::Inch : CellUnit::Millimeter;
}

Result<double> number_of(const ReadCell& read_cell, const std::string& cell,
                         std::string_view what) {
  const auto number = read_cell(cell);
  if (number && std::isfinite(*number)) return *number;
  return fail(Errc::NotFound, "this control has no {}", what);
}

Result<void> check_size(double value, double most, std::string_view what) {
  if (std::fabs(value) <= most) return {};
  return fail(Errc::LimitExceeded, "{} would be {:.4f}: the control takes {} to {}", what, value,
              -most, most);
}

}  // namespace dripline::interpreter
