#include <poll.h>
#include <memory>
#include <thread>

#include "clients/cli/context.hpp"
#include "clients/cli/port/line_examination.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {
namespace {

using std::chrono::milliseconds;

struct DoctorCommand {
  std::string address;
  unsigned listen = 30;  ///< seconds
  bool sends_nothing = false;
};

constexpr milliseconds kOpenLimit{5000};
constexpr unsigned kMaxListen = 3600;

/// The line's device may be readable without anything to read for us (telnet): then time passes.
void wait_for_input(int descriptor, milliseconds time) {
  pollfd entry{descriptor, POLLIN, 0};
  if (::poll(&entry, 1, static_cast<int>(time.count())) > 0) {
    std::this_thread::sleep_for(milliseconds(2));
  }
}

nlohmann::ordered_json json_of(const wire::LineObservation& seen,
                               const wire::LineDiagnosis& diagnosis) {
  nlohmann::ordered_json json;
  json["settings"] = nullptr;
  if (diagnosis.settings) {
    auto& settings = json["settings"] = nlohmann::ordered_json::object();
    settings["line"] = wire::short_form(*diagnosis.settings);
    for (const auto& row : wire::setting_rows()) {
      if (row.key == "code" || row.key == "eob") settings[row.key] = row.get(*diagnosis.settings);
    }
  }
  json["confidence"] = diagnosis.confidence;
  json["characters"] = diagnosis.characters;
  json["after_xoff"] = nullptr;
  if (seen.after_stop) json["after_xoff"] = *seen.after_stop;
  json["stops_at_xoff"] = nullptr;
  if (seen.after_stop) json["stops_at_xoff"] = !seen.never_stopped;
  json["findings"] = diagnosis.findings;
  return json;
}

/// How the findings are written into a port.
std::string advice(const wire::LineDiagnosis& diagnosis) {
  std::string line = "Settings for the port: " + wire::short_form(*diagnosis.settings);
  for (const auto& row : wire::setting_rows()) {
    if (row.key != "code" && row.key != "eob") continue;
    line += fmt::format(" {}={}", row.key, row.get(*diagnosis.settings));
  }
  return line + "\n";
}

Result<wire::LineObservation> examine(const DoctorCommand& command, bool is_for_people) {
  auto channel = serial::open_channel(command.address, wire::LineSettings{}, kOpenLimit);
  if (!channel) return fail(channel.error());
  if (is_for_people) {
    print_error("Let the control punch out a program now; listening for {} s.\n", command.listen);
  }
  const auto begun = std::chrono::steady_clock::now();
  LiveArea area = LiveArea::on_stderr();
  LineExamination parts{
      **channel,
      std::chrono::seconds(command.listen),
      !command.sends_nothing,
      [&](milliseconds time) { wait_for_input((*channel)->descriptor(), time); },
      [begun] { return std::chrono::steady_clock::now() - begun; },
      [] { return is_interrupted(); },
      [&](std::string_view text) { area.show({fmt::format("{}: {}", command.address, text)}); }};
  auto seen = examine_line(parts);
  area.clear();
  return seen;
}

int run_doctor(Context& context, const DoctorCommand& command) {
  catch_interrupts();
  const auto seen = examine(command, !context.wants_json);
  if (!seen) return complain(seen.error());
  const auto diagnosis = wire::diagnose(*seen);
  if (context.wants_json) {
    context.print(json_text(json_of(*seen, diagnosis)));
  } else {
    for (const auto& finding : diagnosis.findings) context.print(finding + "\n");
    if (diagnosis.settings) context.print(advice(diagnosis));
  }
  return diagnosis.settings ? kExitOk : kExitNo;
}

}  // namespace

void add_port_doctor_command(Command group, Context& context) {
  auto command = group.add_subcommand(
      "doctor", "Find the settings and the faults of a line from what its control punches out");
  auto options = std::make_shared<DoctorCommand>();
  command
      .add_option("ADDRESS", options->address,
                  "/dev/ttyUSB0, tcp://HOST:PORT or rfc2217://HOST:PORT; not one in use")
      .required();
  command.add_option("--listen", options->listen, "Seconds to listen (default: 30)")
      .check(in_range(1U, kMaxListen));
  command.add_flag("--send-nothing", options->sends_nothing, "Do not try XOFF");
  add_json_flag(command, context);
  command.footer(
      "No server is needed. Start it, then let the control punch out a program of some length, "
      "again\nif need be: one rate after the other is tried until the text reads as a program.\n"
      "\nExit status: 0 the settings were found, 1 not; what was heard is printed in both cases.");
  command.callback([&context, options] { context.status = run_doctor(context, *options); });
}

}  // namespace dripline::cli
