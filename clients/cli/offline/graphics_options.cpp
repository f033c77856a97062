#include "clients/cli/offline/graphics_options.hpp"

#include <charconv>

namespace dripline::cli {
namespace {

using interpreter::Axis;

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<void> parse_range(std::string_view part, double scale, AxisRanges& ranges) {
  const auto colon = part.find(':');
  const std::size_t axis = part.empty() ? 3 : std::string_view("XYZ").find(part.front());
  if (axis < 3 && colon != std::string_view::npos) {
    const auto low = number_of(part.substr(1, colon - 1));
    const auto high = number_of(part.substr(colon + 1));
    if (low && high && *low < *high) {
      ranges.low[axis] = *low * scale;
      ranges.high[axis] = *high * scale;
      return {};
    }
  }
  return fail(Errc::Syntax, "\"{}\": expected an axis and its range, lower end first, as X0:100",
              part);
}

std::size_t index_of(Axis axis) {
  return static_cast<std::size_t>(axis);
}

}  // namespace

Result<AxisRanges> parse_ranges(std::string_view text, bool is_inch) {
  AxisRanges ranges;
  const double scale = is_inch ? Length::kMillimetersPerInch : 1;
  while (true) {
    const auto comma = text.find(',');
    if (auto part = parse_range(text.substr(0, comma), scale, ranges); !part)
      return fail(part.error());
    if (comma == std::string_view::npos) return ranges;
    text.remove_prefix(comma + 1);
  }
}

Result<graphics::Cuboid> cuboid_of(const AxisRanges& ranges, const graphics::WorkFrame& frame,
                                   const std::optional<graphics::Cuboid>& whole) {
  graphics::Cuboid cuboid = whole.value_or(graphics::Cuboid{});
  const auto take = [&](Axis axis, double& low, double& high) {
    const std::size_t i = index_of(axis);
    if (ranges.low[i]) {
      low = *ranges.low[i];
      high = *ranges.high[i];
    }
    return ranges.low[i] || whole;
  };
  for (const auto& [axis, low, high] : {std::tuple{frame.first, &cuboid.low.u, &cuboid.high.u},
                                        std::tuple{frame.second, &cuboid.low.v, &cuboid.high.v},
                                        std::tuple{frame.along, &cuboid.low.w, &cuboid.high.w}}) {
    if (!take(axis, *low, *high)) {
      return fail(Errc::Syntax, "a blank needs X, Y and Z; {} is missing", letter(axis));
    }
  }
  return cuboid;
}

}  // namespace dripline::cli
