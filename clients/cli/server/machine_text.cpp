#include "clients/cli/server/machine_text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "clients/cli/server/display_text.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {

namespace {

constexpr std::size_t kBarCells = 16;

std::string percent(double factor) {
  return fmt::format("{:.0f} %", factor * 100);
}

std::string after_gap(const std::string& text) {
  return text.empty() ? std::string() : "  " + text;
}

/// The program can continue.
bool is_stopped(std::string_view execution) {
  constexpr std::string_view kInterrupted[] = {"PROGRAM_STOPPED", "OPTIONAL_STOP", "FEED_HOLD",
                                               "INTERRUPTED"};
  return std::ranges::find(kInterrupted, execution) != std::end(kInterrupted);
}

/// The command an operator types next, when the run waits for one.
std::string next_step(const client::Run& run, const client::MachineStatus& status) {
  if (status.execution == "WAIT" && status.message.starts_with("asks: ") &&
      status.remote_enable != "not_given") {
    return fmt::format("dnc run answer {} TEXT answers it", short_id(run.id));
  }
  const bool is_local = status.remote_enable == "not_given";
  if (is_local && status.waits_for == "cycle_start")
    return "cycle start, or the remote enable, is given at the machine";
  if (!is_stopped(status.execution)) return {};
  return fmt::format("dnc run resume {} continues", short_id(run.id));
}

/// The lamp of a control that shows a `*` while a program runs.
std::string star_text(const std::string& execution) {
  if (execution == "ACTIVE" || execution == "WAIT") return "* (running)";
  return is_stopped(execution) ? "* flashing (interrupted)" : "off";
}

std::string with_unit(const std::map<std::string, double>& axes, const client::Display& display) {
  return fmt::format("{} {}", axes_text(axes, display), unit_name(display));
}

void add_motion(Details& details, const client::MachineStatus& status,
                const client::Display& display) {
  if (!status.position.empty()) details.add("position", with_unit(status.position, display));
  details.add("feed", length_text(status.feed_mm_per_min, display) + "/min");
  details.add("spindle", fmt::format("{:.0f} 1/min", status.spindle_rpm));
  details.add("overrides",
              fmt::format("feed {}, rapid {}, spindle {}", percent(status.feed_override),
                          percent(status.rapid_override), percent(status.spindle_override)));
}

std::string number_text(const std::optional<std::int64_t>& value) {
  return value ? std::to_string(*value) : "none";
}

/// "3, offset 13, next 4"
std::string tool_text(const client::ActiveModes& modes) {
  std::string text = number_text(modes.tool);
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

/// What a status window has besides place, position and speeds, in the control's order.
void add_modes(Details& details, const client::ActiveModes& modes, const client::Display& display) {
  details.add("compensation", modes.compensation);
  details.add("tool", tool_text(modes));
  details.add("tool lengths",
              with_unit({{"X", modes.tool_length_x}, {"Z", modes.tool_length_z}},
                        client::Display{.units = display.units}));  // a radius on lathes too
  details.add("tool radius", length_text(modes.tool_radius, display));
  details.add("work system", modes.work_system);
  details.add("interpolation", modes.motion);
  details.add("programmed feed", programmed_feed_text(modes, display));
  details.add("words",
              fmt::format("{}, {}", modes.incremental ? "incremental" : "absolute", modes.units));
  details.add("cycle", modes.cycle.empty() ? "none" : modes.cycle);
  details.add("dwell", fmt::format("{:.1f} s left", modes.dwell_seconds));
  details.add("programmed speed", programmed_speed_text(modes));
  details.add("spindle state", spindle_state_text(modes));
  details.add("spindle load", modes.spindle_load ? percent(*modes.spindle_load) : "not measured");
  details.add("coolant", coolant_text(modes));
}

/// Without its unit: the place on a line is scarce.
std::string bare_feed(double mm, const client::Display& display) {
  const std::string text = feed_text(mm, display);
  return text.substr(0, text.find(' '));
}

std::string remote_enable_text(const std::string& remote_enable) {
  if (remote_enable == "unattended") return "not needed (unattended)";
  return remote_enable == "not_given" ? "not given" : remote_enable;
}

std::string waits_for_text(const std::string& waits_for) {
  if (waits_for == "cycle_start") return "cycle start";
  return waits_for;
}

/// How long the machine can do without the server: seconds of motion, minutes of a line.
std::string buffered_text(double seconds) {
  constexpr double kMinute = 60;
  if (seconds < 2 * kMinute) return fmt::format("{:.1f} s", seconds);
  return fmt::format("{:.1f} min", seconds / kMinute);
}

void add_program(Details& details, const client::MachineStatus& status) {
  details.add("run", status.run);
  details.add("program", status.program);
  details.add("executed", fmt::format("{} blocks, {}", status.executed, place_text(status)));
  details.add("accepted", fmt::format("{} blocks", status.accepted));
  details.add("sent",
              fmt::format("{} of {}", bytes_text(status.sent), bytes_text(status.total_bytes)));
  details.add("buffered", buffered_text(status.buffered_seconds));
}

}  // namespace

Style style_of_execution(const std::string& execution) {
  if (execution == "ACTIVE") return Style::Busy;
  if (execution == "READY" || execution == "PROGRAM_COMPLETED") return Style::Good;
  if (execution == "INTERRUPTED" || execution == "STOPPED") return Style::Bad;
  return Style::Plain;
}

Style style_of_state(const std::string& state) {
  if (state == "completed") return Style::Good;
  if (state == "active" || state == "ordered") return Style::Busy;
  return Style::Bad;
}

bool has_ended(const client::Run& run) {
  return run.state != "ordered" && run.state != "active";
}

std::string position_text(const client::MachineStatus& status, const client::Display& display) {
  if (status.position.empty()) return {};
  const bool is_usual = unit_name(display) == "mm";
  return axes_text(status.position, display) + (is_usual ? "" : " in");
}

std::string place_text(const client::MachineStatus& status) {
  std::string text = fmt::format("line {}", status.line.value_or(0));
  if (status.sequence && *status.sequence >= 0) text += fmt::format(" N{}", *status.sequence);
  return text;
}

double fraction_executed(const client::MachineStatus& status) {
  if (status.total_bytes == 0) return 0;
  if (status.execution == "PROGRAM_COMPLETED") return 1;
  return std::min(1.0,
                  static_cast<double>(status.offset) / static_cast<double>(status.total_bytes));
}

std::string hold_text(const client::Hold& hold) {
  return "by " + printable(hold.who) + (hold.reason.empty() ? "" : ": " + printable(hold.reason));
}

client::MachineStatus status_of(const client::Machine& machine) {
  auto status = machine.status.value_or(client::MachineStatus{});
  if (!machine.held) return status;
  status.message += (status.message.empty() ? "held " : "; held ") + hold_text(*machine.held);
  return status;
}

std::string status_line(const client::Machine& machine) {
  if (!machine.connected) return fmt::format("{}  not connected", machine.name);
  if (!machine.status) return fmt::format("{}  connected, no status yet", machine.name);
  const auto status = status_of(machine);
  std::string line = fmt::format("{}  {}", machine.name, status.execution);
  if (!status.run.empty()) {
    line += fmt::format("  {} {:3.0f} %  {}", status.program, fraction_executed(status) * 100,
                        place_text(status));
  }
  line += after_gap(status.message);
  const client::Display display = display_of(machine);
  if (!status.position.empty()) line += after_gap(with_unit(status.position, display));
  return line + "  F " + feed_text(status.feed_mm_per_min, display);
}

Details machine_details(const client::Machine& machine) {
  Details details;
  details.add("machine", machine.name);
  details.add("control", machine.control);
  details.add("description", machine.description);
  details.add("gateway", machine.gateway_version);
  details.add("connected", machine.connected ? Cell("yes", Style::Good) : Cell("no", Style::Bad));
  details.add("last seen", time_text(machine.last_seen));
  for (const std::string& notice : machine.notices) details.add("notice", Cell(notice, Style::Bad));
  if (machine.held) details.add("held", Cell(hold_text(*machine.held), Style::Bad));
  if (machine.queue_hold)
    details.add("queue held", Cell(hold_text(*machine.queue_hold), Style::Bad));
  if (!machine.status) return details;
  const auto& status = *machine.status;
  details.add("execution", execution_cell(machine));
  details.add("program star", star_text(status.execution));
  details.add("mode", status.mode);
  add_program(details, status);
  const client::Display display = display_of(machine);
  add_motion(details, status, display);
  if (status.coordinates) add_coordinates(details, status, display);
  if (status.modes) add_modes(details, *status.modes, display);
  if (status.emergency_stop) details.add("emergency stop", Cell("pressed", Style::Bad));
  details.add("remote enable", remote_enable_text(status.remote_enable));
  details.add("waits for", waits_for_text(status.waits_for));
  details.add("message", status.message);
  details.add("records waiting", std::to_string(status.outbox));
  return details;
}

Cell execution_cell(const client::Machine& machine) {
  if (!machine.status) return {"", Style::Plain};
  const std::string& last = machine.status->execution;
  if (machine.connected) return {last, style_of_execution(last)};
  return {fmt::format("UNAVAILABLE (last {})", last), Style::Bad};
}

std::string count_text(std::uint64_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::vector<std::string> run_lines(const client::Run& run, const client::MachineStatus* status,
                                   const client::Display& display) {
  if (status == nullptr) {
    return {fmt::format("{} on {}  {}  {} of {} sent  {} executed", run.program, run.machine,
                        run.state, bytes_text(run.sent), bytes_text(run.size),
                        count_text(run.executed, "block"))};
  }
  const double fraction = fraction_executed(*status);
  std::vector<std::string> lines{
      fmt::format("{} on {} {} {:3.0f} %  {}  {}{}", run.program, run.machine,
                  render_bar(fraction, kBarCells), fraction * 100, status->execution,
                  place_text(*status), after_gap(status->message)),
      fmt::format("sent {}  accepted {}  executed {}  {}  F {}",
                  bytes_text(std::max(run.sent, status->sent)),
                  std::max(run.accepted, status->accepted),
                  std::max(run.executed, status->executed), position_text(*status, display),
                  bare_feed(status->feed_mm_per_min, display))};
  if (auto hint = next_step(run, *status); !hint.empty()) lines.push_back(std::move(hint));
  return lines;
}

std::string run_line(const client::Run& run, const client::MachineStatus* status,
                     const client::Display& display) {
  return fmt::format("{}", fmt::join(run_lines(run, status, display), "  "));
}

std::string waiting_line(const client::Run& run, const client::MachineStatus& status) {
  const std::string step = next_step(run, status);
  if (step.empty()) return {};
  const std::string what = status.message.empty() ? status.execution : status.message;
  return fmt::format("run {} waits: {}; {}", short_id(run.id), what, step);
}

std::string record_line(const client::Record& record) {
  std::string text = record.text;
  if (record.kind == "alarm" || record.kind == "warning") {
    const auto json = nlohmann::json::parse(record.text, nullptr, false);
    const auto field = [&](const char* name) {
      const bool has = json.is_object() && json.contains(name) && json[name].is_string();
      return has ? json[name].get<std::string>() : std::string();
    };
    if (!field("code").empty()) text = field("code") + " " + field("text");
  }
  return fmt::format("{}  line {}  {}", record.kind, record.line.value_or(0), text);
}

std::string outcome_line(const client::Run& run) {
  std::string line =
      fmt::format("Run {} of {} on {} {}: {} executed", short_id(run.id), run.program, run.machine,
                  run.state, count_text(run.executed, "block"));
  const double seconds = seconds_between(run.started, run.ended);
  if (seconds > 0) line += " in " + duration_text(seconds);
  if (run.outputs > 0) line += ", " + count_text(run.outputs, "report line");
  if (run.content_verified) {
    line += *run.content_verified ? ", content verified" : ", CONTENT NOT WHAT WAS APPROVED";
  }
  if (run.state != "completed" && run.line) line += fmt::format(", last line {}", *run.line);
  if (!run.reason.empty()) line += "; " + printable(run.reason);
  return line;
}

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

void add_frame(Details& details, const client::ProgramFrame& frame,
               const client::Display& display) {
  details.add("datum", with_unit(frame.datum, display));
  details.add("datum shift", with_unit(frame.shift, display));
  details.add("rotation (ROT)", rotation_text(frame));
  details.add("scale (SCL)", scale_text(frame.scale));
  details.add("mirrored",
              frame.mirrored.empty() ? "none" : fmt::format("{}", fmt::join(frame.mirrored, " ")));
  details.add("pole (CC)", frame.pole ? with_unit(*frame.pole, display) : "none");
}

}  // namespace

void add_coordinates(Details& details, const client::MachineStatus& status,
                     const client::Display& display) {
  const client::Coordinates& all = *status.coordinates;
  if (all.program) {
    details.add("actual (ACTL)", with_unit(all.program->position, display));
    details.add("nominal (NOML)",
                with_unit(all.program->target, display) + ", where the move ends");
  }
  details.add("reference (REF)", with_unit(status.position, display));
  details.add("distance to go (DIST)", with_unit(all.distance_to_go, display));
  details.add("following error (LAG)",
              all.following_error ? with_unit(*all.following_error, display) : "not measured");
  if (all.program) add_frame(details, *all.program, display);
}

}  // namespace dripline::cli
