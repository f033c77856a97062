#include "clients/cli/server/status_window.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "clients/cli/server/display_text.hpp"
#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {

namespace {

std::string percent_text(double factor) {
  return fmt::format("{:.0f} %", factor * 100);
}

/// Of the screen: the name of a position, where an operator chooses one.
std::string_view choice_name(const client::MachineStatus& status) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {{"actual", "ACTL"},
                                                                      {"reference", "REF"},
                                                                      {"following_error", "LAG"},
                                                                      {"nominal", "NOML"},
                                                                      {"distance_to_go", "DIST"}};
  if (!status.screen) return {};
  for (const auto& [word, name] : kNames)
    if (status.screen->position == word) return name;
  return {};
}

/// "position", "position (DIST)". Where what the operator chose is not known it is the machine's.
std::string position_name(const client::MachineStatus& status) {
  const std::string_view name = choice_name(status);
  if (status.coordinates && !status.coordinates->program) {
    if (name == "ACTL") return "machine position (REF)";
    if (name == "NOML") return "machine position, where the move ends";
  }
  return name.empty() ? "position" : fmt::format("position ({})", name);
}

/// "actual", "actual (ACTL)": with the control's own name where it has these displays.
std::string display_name(const client::MachineStatus& status, std::string_view words,
                         std::string_view name) {
  return choice_name(status).empty() ? std::string(words) : fmt::format("{} ({})", words, name);
}

bool has_field(const client::Display& display, std::string_view field) {
  return !display.fields || std::ranges::find(*display.fields, field) != display.fields->end();
}

std::string tool_number_text(const std::optional<std::int64_t>& value) {
  return value ? std::to_string(*value) : "none";
}

/// "3, offset 13, next 4"
std::string tool_text(const client::ActiveModes& modes) {
  std::string text = tool_number_text(modes.tool);
  if (modes.tool_offset) text += fmt::format(", offset {}", *modes.tool_offset);
  if (modes.next_tool) text += fmt::format(" (next {})", *modes.next_tool);
  if (!modes.tool_axis.empty()) text += fmt::format(", axis {}", modes.tool_axis);
  return text;
}

std::string programmed_feed_text(const client::ActiveModes& modes, const client::Display& display) {
  const std::string feed = modes.feed_unit == "inverse_time"
                               ? fmt::format("{:.3f} moves per minute", modes.feed)
                               : length_text(modes.feed, display) +
                                     (modes.feed_unit == "per_revolution" ? "/rev" : "/min");
  return feed + (modes.feed_limited ? ", limited by an axis" : "");
}

std::string programmed_speed_text(const client::ActiveModes& modes) {
  if (!modes.surface_speed) return fmt::format("{:.0f} 1/min", modes.spindle_speed);
  return fmt::format("{:.1f} m/min at the surface", modes.spindle_speed / 1000);
}

std::string coolant_text(const client::ActiveModes& modes) {
  if (modes.flood && modes.mist) return "flood and mist";
  return modes.flood ? "flood" : modes.mist ? "mist" : "off";
}

/// "clockwise (M03)"
std::string spindle_state_text(const client::ActiveModes& modes) {
  if (modes.spindle == "clockwise") return "clockwise (M03)";
  if (modes.spindle == "counterclockwise") return "counterclockwise (M04)";
  if (modes.spindle == "off") return "off (M05)";
  return modes.spindle.empty() ? "not reported" : modes.spindle;
}

void add_tool(Details& details, const client::ActiveModes& modes, const client::Display& display) {
  details.add("tool", tool_text(modes));
  const bool has_x = has_field(display, "tool_length_x");
  if (has_x) {
    details.add("tool lengths",
                with_unit({{"X", modes.tool_length_x}, {"Z", modes.tool_length_z}},
                          client::Display{.units = display.units}));  // a radius on lathes too
  } else if (has_field(display, "tool_length_z")) {
    details.add("tool length", length_text(modes.tool_length_z, display));
  }
  if (has_field(display, "tool_radius"))
    details.add("tool radius", length_text(modes.tool_radius, display));
}

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

std::string mirrored_text(const client::ProgramFrame& frame) {
  return frame.mirrored.empty() ? "none" : fmt::format("{}", fmt::join(frame.mirrored, " "));
}

/// A HEIDENHAIN control shows all of it. Another one has no such fields: there it is what lies
/// between the machine and its program's coordinates, as far as something does.
void add_frame(Details& details, const client::MachineStatus& status,
               const client::Display& display) {
  const client::ProgramFrame& frame = *status.coordinates->program;
  details.add("datum", with_unit(frame.datum, display));
  details.add("datum shift", with_unit(frame.shift, display));
  if (!choice_name(status).empty()) {
    details.add("rotation (ROT)", rotation_text(frame));
    details.add("scale (SCL)", scale_text(frame.scale));
    details.add("mirrored", mirrored_text(frame));
    details.add("pole (CC)", frame.pole ? with_unit(*frame.pole, display) : "none");
    return;
  }
  const auto is_scaled = [](const auto& axis) { return axis.second != 1; };
  if (frame.rotation != 0 || frame.basic_rotation != 0)
    details.add("rotation", rotation_text(frame));
  if (std::ranges::any_of(frame.scale, is_scaled)) details.add("scale", scale_text(frame.scale));
  if (!frame.mirrored.empty()) details.add("mirrored", mirrored_text(frame));
}

}  // namespace

std::string with_unit(const std::map<std::string, double>& axes, const client::Display& display) {
  return fmt::format("{} {}", axes_text(axes, display), unit_name(display));
}

const std::map<std::string, double>& shown_position(const client::MachineStatus& status) {
  if (!status.screen || !status.coordinates) return status.position;
  const std::string& choice = status.screen->position;
  const client::Coordinates& all = *status.coordinates;
  if (choice == "distance_to_go") return all.distance_to_go;
  if (choice == "following_error" && all.following_error) return *all.following_error;
  if (choice == "nominal") return all.program ? all.program->target : all.target;
  if (choice == "actual" && all.program) return all.program->position;
  return status.position;
}

void add_motion(Details& details, const client::MachineStatus& status,
                const client::Display& display) {
  const auto& position = shown_position(status);
  if (!position.empty()) details.add(position_name(status), with_unit(position, display));
  details.add("feed", feed_text(status.feed_mm_per_min, display));
  details.add("spindle", fmt::format("{:.0f} 1/min", status.spindle_rpm));
  details.add(
      "overrides",
      fmt::format("feed {}, rapid {}, spindle {}", percent_text(status.feed_override),
                  percent_text(status.rapid_override), percent_text(status.spindle_override)));
}

/// What a status window has besides place, position and speeds, in the control's order: what the
/// control does not have is left out.
void add_modes(Details& details, const client::ActiveModes& modes, const client::Display& display) {
  if (has_field(display, "compensation")) details.add("compensation", modes.compensation);
  add_tool(details, modes, display);
  if (has_field(display, "work_system")) details.add("work system", modes.work_system);
  details.add("interpolation", modes.motion);
  details.add("programmed feed", programmed_feed_text(modes, display));
  if (has_field(display, "incremental")) {
    details.add("words",
                fmt::format("{}, {}", modes.incremental ? "incremental" : "absolute", modes.units));
  }
  if (has_field(display, "cycle")) details.add("cycle", modes.cycle.empty() ? "none" : modes.cycle);
  details.add("dwell", fmt::format("{:.1f} s left", modes.dwell_seconds));
  details.add("programmed speed", programmed_speed_text(modes));
  details.add("spindle state", spindle_state_text(modes));
  details.add("spindle load",
              modes.spindle_load ? percent_text(*modes.spindle_load) : "not measured");
  details.add("coolant", coolant_text(modes));
}

/// As far as the control shows them and their text is at hand.
void add_statistics(Details& details, const client::RunStatistics& statistics,
                    const client::Display& display) {
  details.add("motion time", fmt::format("{:.1f} s", statistics.motion_seconds));
  details.add("distance", length_text(statistics.distance_mm, display));
  if (statistics.average_feed_mm_per_min)
    details.add("average feed", feed_text(*statistics.average_feed_mm_per_min, display));
  if (statistics.average_block_seconds && statistics.blocks_per_second) {
    details.add("block time",
                fmt::format("{:.4f} s on average, {:.1f} blocks/s",
                            *statistics.average_block_seconds, *statistics.blocks_per_second));
  }
}

void add_blocks(Details& details, const client::Screen& screen) {
  const auto add = [&details](const char* name, const std::string& text) {
    if (!text.empty()) details.add(name, printable(text));
  };
  add("previous block", screen.previous_block);
  add("block", screen.block);
  add("next block", screen.next_block);
  add("block after it", screen.further_block);
}

void add_coordinates(Details& details, const client::MachineStatus& status,
                     const client::Display& display) {
  const client::Coordinates& all = *status.coordinates;
  if (all.program) {
    details.add(display_name(status, "actual", "ACTL"), with_unit(all.program->position, display));
    details.add(display_name(status, "nominal", "NOML"),
                with_unit(all.program->target, display) + ", where the move ends");
  }
  details.add(display_name(status, "reference", "REF"), with_unit(status.position, display));
  details.add(display_name(status, "distance to go", "DIST"),
              with_unit(all.distance_to_go, display));
  details.add(display_name(status, "following error", "LAG"),
              all.following_error ? with_unit(*all.following_error, display) : "not measured");
  if (all.program) add_frame(details, status, display);
}

}  // namespace dripline::cli
