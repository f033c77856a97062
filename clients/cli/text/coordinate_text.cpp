#include "clients/cli/text/coordinate_text.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::cli {
namespace {

/// "30.000 degrees", "30.000 degrees, basic rotation 2.500"
std::string rotation_text(const client::ProgramFrame& frame) {
  std::string text = fmt::format("{:.3f} degrees", frame.rotation);
  if (frame.basic_rotation != 0)
    text += fmt::format(", basic rotation {:.3f}", frame.basic_rotation);
  return text;
}

/// One factor where it is the same for all axes that have one: "0.5"; else "X 0.5 Y 0.5 Z 1".
std::string scale_text(const std::map<std::string, double>& scale) {
  if (scale.empty()) return "1";
  const double first = scale.begin()->second;
  const bool is_even =
      std::ranges::all_of(scale, [first](const auto& axis) { return axis.second == first; });
  if (is_even) return fmt::format("{:.6g}", first);
  std::string text;
  for (const auto& [axis, factor] : scale)
    text += fmt::format("{}{} {:.6g}", text.empty() ? "" : " ", axis, factor);
  return text;
}

void add_frame(Details& details, const client::ProgramFrame& frame) {
  details.add("datum", axes_text(frame.datum) + " mm");
  details.add("datum shift", axes_text(frame.shift) + " mm");
  details.add("rotation (ROT)", rotation_text(frame));
  details.add("scale (SCL)", scale_text(frame.scale));
  details.add("mirrored",
              frame.mirrored.empty() ? "none" : fmt::format("{}", fmt::join(frame.mirrored, " ")));
  details.add("pole (CC)", frame.pole ? axes_text(*frame.pole) + " mm" : "none");
}

}  // namespace

std::string axes_text(const std::map<std::string, double>& axes) {
  std::string text;
  // JSON objects do not keep an order.
  constexpr std::string_view kOrder = "XYZABCUVW";
  for (const char axis : kOrder) {
    const auto found = axes.find(std::string(1, axis));
    if (found == axes.end()) continue;
    text += fmt::format("{}{} {:.3f}", text.empty() ? "" : " ", axis, found->second);
  }
  return text;
}

void add_coordinates(Details& details, const client::MachineStatus& status) {
  const client::Coordinates& all = *status.coordinates;
  if (all.program) {
    details.add("actual (ACTL)", axes_text(all.program->position) + " mm");
    details.add("nominal (NOML)", axes_text(all.program->target) + " mm, where the move ends");
  }
  details.add("reference (REF)", axes_text(status.position) + " mm");
  details.add("distance to go (DIST)", axes_text(all.distance_to_go) + " mm");
  details.add("following error (LAG)",
              all.following_error ? axes_text(*all.following_error) + " mm" : "not measured");
  if (all.program) add_frame(details, *all.program);
}

}  // namespace dripline::cli
