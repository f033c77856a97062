#include <fstream>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/tools/lines/line_replay.hpp"
#include "clients/tools/offline/check_summary.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::cli {
namespace {

struct ReplayCommand {
  std::string file, control, dialect;
  std::vector<std::string> settings;
};

/// A template's name, or a dialect's whose template is the first one.
Result<const wire::LineTemplate*> template_of(const std::string& control) {
  for (const auto& row : wire::line_templates()) {
    if (row.control == control) return &row;
  }
  return wire::find_template(control);
}

Result<wire::LineSettings> settings_of(const ReplayCommand& command,
                                       const wire::LineTemplate& line) {
  wire::LineSettings settings = line.settings;
  for (const auto& setting : command.settings) {
    const auto equals = setting.find('=');
    if (equals == setting.npos) {
      if (auto set = wire::set_value(settings, "line", setting); !set) return fail(set.error());
      continue;
    }
    auto set = wire::set_value(settings, setting.substr(0, equals), setting.substr(equals + 1));
    if (!set) return fail(set.error());
  }
  return settings;
}

std::optional<std::string> from_hex(std::string_view digits) {
  const auto value = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  if (digits.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const int high = value(digits[i]), low = value(digits[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    bytes += static_cast<char>(high * 16 + low);
  }
  return bytes;
}

/// One line of a recording. Errors: Syntax.
Result<wire::RecordedTraffic> entry_of(std::string_view line, std::string& first_time) {
  const auto json = client::parse_json(line);
  if (!json) return fail(json.error());
  const auto traffic = client::from_json<client::Traffic>(*json);
  if (!traffic) return fail(traffic.error());
  if (first_time.empty()) first_time = traffic->time;
  wire::RecordedTraffic entry;
  const std::chrono::duration<double> since(seconds_between(first_time, traffic->time));
  entry.time = std::chrono::duration_cast<wire::LineTime>(since);
  using enum wire::RecordedTraffic::What;
  entry.what = traffic->what == "sent"       ? Sent
               : traffic->what == "received" ? Received
               : traffic->what == "fault"    ? Fault
               : traffic->what == "lines"    ? Lines
                                             : Note;
  auto bytes = from_hex(traffic->bytes);
  if (!bytes) return fail(Errc::Syntax, "'{}' is no hexadecimal", traffic->bytes);
  entry.bytes = *std::move(bytes);
  return entry;
}

Result<wire::ReplayReport> replay(const std::string& path, const wire::LineSettings& settings) {
  std::ifstream file(path);
  if (!file) return fail(Errc::Io, "{} cannot be read", path);
  auto replay = wire::LineReplay::make(settings);
  if (!replay) return fail(replay.error());
  std::string first_time;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty()) continue;
    const auto entry = entry_of(line, first_time);
    if (!entry) {
      return fail(Errc::Syntax, "{}: line {}: {}", path, number, entry.error().what);
    }
    replay->play(*entry);
  }
  return replay->finish();
}

/// Describes in a sentence how the control's interpreter reads a text.
std::string interpreted(const interpreter::Dialect& dialect, const std::string& text) {
  const interpreter::Setup setup;
  interpreter::MemorySource source(text);
  interpreter::CheckSummary summary(setup.start);
  constexpr interpreter::OfflineLimits kLimits{10'000'000};
  const auto outcome = interpreter::run_offline(dialect, setup, source, summary, kLimits);
  if (!outcome) return fmt::format("{} cannot run it: {}", dialect.name, outcome.error().what);
  if (outcome->ended) {
    return fmt::format("{} runs it to its end: {} blocks, {} warnings", dialect.name,
                       outcome->blocks, outcome->warnings);
  }
  const auto& alarm = *outcome->alarm;
  return fmt::format("{} stops with {} at line {}: {}", dialect.name, alarm.id, alarm.line,
                     alarm.text);
}

struct Judged {
  wire::ReplayReport report;
  std::vector<std::string> verdicts;  ///< of the transfers to the control
};

nlohmann::ordered_json transfers_json(const std::vector<wire::ReplayReport::Transfer>& transfers,
                                      const std::vector<std::string>& verdicts) {
  auto array = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < transfers.size(); ++i) {
    nlohmann::ordered_json json{{"name", transfers[i].name},
                                {"bytes", transfers[i].text.size()},
                                {"ended", transfers[i].has_ended},
                                {"verdict", nullptr}};
    if (i < verdicts.size()) json["verdict"] = verdicts[i];
    array.push_back(std::move(json));
  }
  return array;
}

void print_json(Context& context, const Judged& judged) {
  const auto& report = judged.report;
  context.print(json_text(
      nlohmann::ordered_json{{"sent", report.sent},
                             {"received", report.received},
                             {"faults", report.faults},
                             {"deviations", report.deviations},
                             {"to_control", transfers_json(report.to_control, judged.verdicts)},
                             {"from_control", transfers_json(report.from_control, {})},
                             {"findings", report.findings}}));
}

std::string transfer_line(const char* direction, const wire::ReplayReport::Transfer& transfer) {
  const auto blocks = std::count(transfer.text.begin(), transfer.text.end(), '\n');
  return fmt::format("{}{}{}: {} blocks, {}{}\n", direction, transfer.name.empty() ? "" : " ",
                     transfer.name, blocks, bytes_text(transfer.text.size()),
                     transfer.has_ended ? "" : ", without an end");
}

void print_text(Context& context, const Judged& judged) {
  const auto& report = judged.report;
  for (const auto& finding : report.findings) context.print(finding + "\n");
  for (std::size_t i = 0; i < report.to_control.size(); ++i) {
    context.print(transfer_line("To the control", report.to_control[i]));
    if (i < judged.verdicts.size()) context.print("  " + judged.verdicts[i] + "\n");
  }
  for (const auto& transfer : report.from_control) {
    context.print(transfer_line("From the control", transfer));
  }
  context.print(fmt::format("{} characters sent, {} received, {} faults, {} deviations\n",
                            report.sent, report.received, report.faults, report.deviations));
}

int run_replay(Context& context, const ReplayCommand& command) {
  const auto line = template_of(command.control);
  if (!line) return complain(line.error());
  const auto settings = settings_of(command, **line);
  if (!settings) return complain(settings.error());
  const std::string dialect_name =
      command.dialect.empty() ? std::string((*line)->control) : command.dialect;
  const interpreter::Dialect* dialect = nullptr;
  if (const auto found = interpreter::find_dialect(dialect_name)) {
    dialect = *found;
  } else if (!command.dialect.empty()) {
    return complain(found.error());
  }
  auto report = replay(command.file, *settings);
  if (!report) return complain(report.error());
  Judged judged{*std::move(report), {}};
  for (const auto& transfer : judged.report.to_control) {
    if (dialect != nullptr) judged.verdicts.push_back(interpreted(*dialect, transfer.text));
  }
  context.wants_json ? print_json(context, judged) : print_text(context, judged);
  return judged.report.deviations == 0 ? kExitOk : kExitNo;
}

}  // namespace

void add_port_replay_command(Command group, Context& context) {
  auto command = group.add_subcommand(
      "replay", "Play a recorded line against a simulated control, and show where it differs");
  auto options = std::make_shared<ReplayCommand>();
  command.add_option("RECORDING", options->file, "JSON lines, see dnc port recording -o")
      .required();
  command
      .add_option("--against", options->control,
                  "The control: a template (dnc port templates) or a dialect")
      .required();
  command.add_option("--dialect", options->dialect,
                     "Dialect that interprets the received program (default: the template's)");
  command.add_option("SETTING", options->settings,
                     "Override a setting of the template (KEY=VALUE), or give rate, parity, data "
                     "and stop bits in short form (9600e72)");
  add_json_flag(command, context);
  command.footer(
      "No server is needed. What was sent goes to the simulated control, and its answers are "
      "compared\nwith the recorded ones where a protocol decides them (XMODEM, HEIDENHAIN "
      "blockwise); what the\ncontrol sent goes to a simulated host.\n\nExit status: 0 no "
      "deviations, 1 deviations, 2 the recording cannot be read.\n\nExample:\n  dnc port recording "
      "line-3 -o night.jsonl\n  dnc port replay night.jsonl --against tnc155-bcc");
  command.callback([&context, options] { context.status = run_replay(context, *options); });
}

}  // namespace dripline::cli
