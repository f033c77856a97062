#include "clients/cli/server/machine_text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "clients/cli/server/display_text.hpp"
#include "clients/cli/server/status_window.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {

namespace {

constexpr std::size_t kRunBarCells = 16;

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
  if (status.screen) add_blocks(details, *status.screen);
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
  if (state == "completed" || state == "tested") return Style::Good;
  if (state == "active" || state == "ordered") return Style::Busy;
  return Style::Bad;
}

bool has_ended(const client::Run& run) {
  return run.state != "ordered" && run.state != "active";
}

std::string position_text(const client::MachineStatus& status, const client::Display& display) {
  if (status.position.empty()) return {};
  const bool is_usual = unit_name(display) == "mm";
  return axes_text(shown_position(status), display) + (is_usual ? "" : " in");
}

std::string block_line(const client::MachineStatus& status) {
  return status.screen ? printable(status.screen->block) : std::string();
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
  if (machine.stale)
    return fmt::format("{}  connected, but its status does not arrive (last {})", machine.name,
                       status.execution);
  std::string line = fmt::format("{}  {}", machine.name, status.execution);
  if (!status.run.empty()) {
    line += fmt::format("  {} {:3.0f} %  {}", status.program, fraction_executed(status) * 100,
                        place_text(status));
    line += after_gap(block_line(status));
  }
  line += after_gap(status.message);
  const client::Display display = display_of(machine);
  if (!status.position.empty()) line += after_gap(with_unit(shown_position(status), display));
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
  details.add("switches on", switches_text(status));
  details.add("remote enable", remote_enable_text(status.remote_enable));
  details.add("waits for", waits_for_text(status.waits_for));
  details.add("message", status.message);
  details.add("records waiting", std::to_string(status.outbox));
  return details;
}

std::string switches_text(const client::MachineStatus& status) {
  std::string text = status.single_block ? "single_block" : "";
  const auto add = [&text](std::string_view name, std::string_view state) {
    if (state == "on") text += fmt::format("{}{}", text.empty() ? "" : ", ", name);
  };
  if (!status.switches) return text;
  const client::PanelSwitches& switches = *status.switches;
  add("optional_stop", switches.optional_stop);
  add("block_skip", switches.block_skip);
  if (!switches.skip_levels.empty()) add("block_skip_" + switches.skip_levels, "on");
  add("dry_run", switches.dry_run);
  add("machine_lock", switches.machine_lock);
  add("handwheel", switches.handwheel);
  add("test_run", switches.test_run);
  return text;
}

Cell execution_cell(const client::Machine& machine) {
  if (!machine.status) return {"", Style::Plain};
  const std::string& last = machine.status->execution;
  if (machine.stale) return {fmt::format("STALE (last {})", last), Style::Bad};
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
                  render_bar(fraction, kRunBarCells), fraction * 100, status->execution,
                  place_text(*status), after_gap(status->message)),
      fmt::format("sent {}  accepted {}  executed {}  {}  F {}",
                  bytes_text(std::max(run.sent, status->sent)),
                  std::max(run.accepted, status->accepted),
                  std::max(run.executed, status->executed), position_text(*status, display),
                  bare_feed(status->feed_mm_per_min, display))};
  if (auto block = block_line(*status); !block.empty()) lines.push_back(std::move(block));
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
  const bool has_place = run.line.value_or(0) > 0;  // of the program, once a block was executed
  if (run.state != "completed" && has_place) line += fmt::format(", last line {}", *run.line);
  if (!run.reason.empty()) line += "; " + printable(run.reason);
  return line;
}

}  // namespace dripline::cli
