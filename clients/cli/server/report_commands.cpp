#include <algorithm>
#include <cstdio>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/measurements/archived_listing.hpp"
#include "clients/cli/measurements/export_formats.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct ReportListCommand {
  client::ReportQuery query;
  std::uint64_t limit = 20;
};

struct ExportCommand {
  std::string run, format, output;
  MeasurementExport measurements;
};

/// The lines that machines printed outside any run; only those of `machine` when it is named.
client::Reply<std::vector<client::MachineReport>> machine_reports(client::Client& client,
                                                                  const std::string& machine) {
  auto reports = client.machine_reports();
  if (reports && !machine.empty()) {
    std::erase_if(*reports, [&](const auto& report) { return report.machine != machine; });
  }
  return reports;
}

Table table_of(const std::vector<client::Report>& reports) {
  Table table(
      {"RUN", "MACHINE", "PROGRAM", right("REV"), "STATE", right("LINES"), "STARTED", "ENDED"});
  for (const auto& report : reports) {
    table.add({short_id(report.run), report.machine, report.program,
               std::to_string(report.revision), Cell(report.state, style_of_state(report.state)),
               std::to_string(report.lines), time_text(report.started), time_text(report.ended)});
  }
  return table;
}

Table table_of(const std::vector<client::MachineReport>& reports) {
  Table table({"MACHINE", right("LINES OUTSIDE RUNS"), "FIRST", "LAST"});
  for (const auto& report : reports) {
    table.add({report.machine, std::to_string(report.lines), time_text(report.first),
               time_text(report.last)});
  }
  return table;
}

template <class T>
nlohmann::ordered_json json_array(const std::vector<T>& items) {
  auto array = nlohmann::ordered_json::array();
  for (const auto& item : items) array.push_back(client::to_json_value(item));
  return array;
}

int list_reports(Context& context, client::Client& client, const ReportListCommand& command) {
  auto reports = fetch_all(command.limit, [&](client::Page page) {
    client::ReportQuery query = command.query;
    query.page = page;
    return client.reports(query);
  });
  if (!reports) return complain(reports.error());
  client::Reply<std::vector<client::MachineReport>> machines{};
  if (command.query.program.empty()) machines = machine_reports(client, command.query.machine);
  if (!machines) return complain(machines.error());
  if (context.wants_json) {
    context.print(json_text(nlohmann::ordered_json{{"reports", json_array(*reports)},
                                                   {"machine_reports", json_array(*machines)}}));
    return kExitOk;
  }
  if (reports->empty()) {
    context.print("No run has reported a line yet.\n");
  } else {
    context.print(table_of(*reports));
  }
  if (machines->empty()) return kExitOk;
  context.print("\n");
  context.print(table_of(*machines));
  return kExitOk;
}

/// Whose lines are meant.
struct ReportOf {
  std::optional<client::Run> run;
  std::string machine;  ///< what it printed outside runs; empty: the run's

  std::string name() const {
    return run ? "run " + short_id(run->id) : "machine " + machine + " outside runs";
  }
  client::Reply<void> write(client::Client& client, const std::string& format,
                            const std::function<bool(std::string_view)>& sink) const {
    return run ? client.export_report(run->id, format, sink)
               : client.export_machine_report(machine, format, sink);
  }
};

/// A run goes before a machine of that name. The error speaks of runs.
client::Reply<ReportOf> find_report(client::Client& client, const std::string& reference) {
  auto run = find_run(client, reference);
  if (run) return ReportOf{.run = *std::move(run), .machine = {}};
  if (run.error().kind != client::Failure::Kind::Refused) return client::failed(run.error());
  if (auto machine = client.machine(reference)) {
    return ReportOf{.run = {}, .machine = machine->name};
  }
  return client::failed(run.error());
}

int print_report(client::Client& client, const ReportOf& report, const std::string& format,
                 Content content) {
  StandardOutput output(content);
  auto printed = report.write(
      client, format, [&](std::string_view bytes) { return output.write(bytes).has_value(); });
  if (output.error()) return output.complain();
  return printed ? kExitOk : complain(printed.error());
}

struct ShowCommand {
  std::string run;
  ArchiveChoice archive;
  bool is_raw = false;
};

int show(Context& context, client::Client& client, const ShowCommand& command) {
  auto report = find_report(client, command.run);
  if (!report) return complain(report.error());
  const auto content = command.is_raw ? Content::Raw : Content::Data;
  if (context.wants_json) return print_report(client, *report, "json", content);
  if (const auto& run = report->run) {
    context.print(fmt::format("Report of run {}: {} revision {} on {}, {}, {}\n\n",
                              short_id(run->id), run->program, run->revision, run->machine,
                              run->state, count_text(run->outputs, "line")));
  } else {
    context.print(fmt::format("Printed by machine {} outside any run\n\n", report->machine));
  }
  return print_report(client, *report, "text", content);
}

int export_to_file(client::Client& client, const ReportOf& report, const ExportCommand& command) {
  const int status = save_content(command.output, [&](const ContentSink& sink) {
    return report.write(client, command.format, sink);
  });
  if (status == kExitOk) {
    print_error("Wrote the report of {} to {}\n", report.name(), command.output);
  }
  return status;
}

int export_lines(client::Client& client, const ExportCommand& command) {
  auto report = find_report(client, command.run);
  if (!report) return complain(report.error());
  if (!command.output.empty() && command.output != "-") {
    return export_to_file(client, *report, command);
  }
  return print_report(client, *report, command.format, Content::Data);
}

/// An option that a format does not use is refused by its name.
Result<void> check_format_options(const ExportCommand& command) {
  const MeasurementExport& of = command.measurements;
  struct Row {
    const char* option;
    bool is_given;
    std::vector<std::string_view> formats;
  };
  for (const Row& row :
       {Row{"--title", !of.title.empty(), {"html", "pdf"}},
        Row{"--utf8", of.is_utf8, {"dfq", "dfd"}}, Row{"--cell", of.cell.has_value(), {"stl"}},
        Row{"--base", of.base.has_value(), {"stl"}},
        Row{"--x", !of.x.empty(), {"points", "dxf", "stl"}}}) {
    if (!row.is_given || std::ranges::count(row.formats, command.format) > 0) continue;
    return fail(Errc::Syntax, "{} is for --format {}, not {}", row.option,
                fmt::join(row.formats, " and "), command.format);
  }
  return {};
}

Result<void> check_choice_options(const ExportCommand& command, bool is_lines) {
  const auto& choice = command.measurements.choice;
  const auto& query = choice.query;
  const std::pair<const char*, const std::string&> options[]{
      {"--characteristic", query.characteristic},
      {"--tool", choice.tool},
      {"--since", query.since},
      {"--until", query.until},
      {"--run", query.run},
      {"--machine", query.machine}};
  for (const auto& [name, value] : options) {
    if (is_lines && !value.empty()) {
      return fail(Errc::Syntax,
                  "{} is for measurements: --format {} exports all report lines of RUN|MACHINE",
                  name, command.format);
    }
  }
  if (command.run.empty()) return {};
  if (!choice.file.empty())
    return fail(Errc::Syntax, "--from and {}: the file or the server's", command.run);
  if (query.run.empty() && query.machine.empty()) return {};
  return fail(Errc::Syntax, "{} and {}: give RUN|MACHINE, or --run and --machine", command.run,
              query.run.empty() ? "--machine" : "--run");
}

int export_report(Context& context, const ExportCommand& command) {
  const bool has_file = !command.measurements.choice.file.empty();
  const bool is_lines = !std::ranges::count(measurement_formats(), command.format);
  for (const auto& checked :
       {check_format_options(command), check_choice_options(command, is_lines)}) {
    if (checked) continue;
    complain(checked.error());
    return kExitUsage;
  }
  if (is_lines && (has_file || command.run.empty())) {
    complain(
        Error{Errc::Syntax, "--format " + command.format +
                                " exports report lines: RUN or MACHINE is needed, and no --from"});
    return kExitUsage;
  }
  if (is_lines) {
    auto client = context.connect();
    return client ? export_lines(*client, command) : context.status;
  }
  MeasurementExport request = command.measurements;
  request.format = command.format;
  request.output = command.output;
  if (!command.run.empty()) {
    auto client = context.connect();
    if (!client) return context.status;
    const auto report = find_report(*client, command.run);
    if (!report) return complain(report.error());
    if (report->run) request.choice.query.run = report->run->id;
    if (!report->run) request.choice.query.machine = report->machine;
  }
  return export_measurements(context, request);
}

constexpr const char* kReportHelp =
    "Run: its id, the beginning of it, or latest; or a machine: what it printed outside any run";

void add_export(Command group, Context& context) {
  auto command = group.add_subcommand(
      "export", "Export report lines, measurements, digitized points or a printable part report");
  auto options = std::make_shared<ExportCommand>();
  options->format = "text";
  std::vector<std::string> formats{"text", "csv", "json"};
  formats.insert(formats.end(), measurement_formats().begin(), measurement_formats().end());
  command.add_option("RUN|MACHINE", options->run, kReportHelp);
  command.add_option("--format", options->format, "Format to write, see below [text]")
      .check(one_of(formats));
  command.add_option("-o,--output", options->output, "File to write, - for standard output [-]");
  auto& measurements = options->measurements;
  command.add_option(
      "--from", measurements.choice.file,
      "Measurements of this file (CSV, JSON Lines, .dfq, archive), without a server");
  add_measurement_choice(command, measurements.choice);
  command.add_option("--title", measurements.title,
                     "html, pdf: title of the report [Measurement report]");
  command.add_flag("--utf8", measurements.is_utf8, "dfq, dfd: write UTF-8 instead of Windows-1252");
  command.add_option("--cell", measurements.cell,
                     "stl: width of a cell, mm [distance of the points]");
  command.add_option("--base", measurements.base,
                     "stl: height of the base below the lowest point, mm [5]");
  command
      .add_option("--x", measurements.x,
                  "points, dxf, stl: what X of the measured points is, radius or diameter (a "
                  "lathe's program prints diameters); written are radii [radius]")
      .check(one_of({"radius", "diameter"}));
  command.footer(
      "Report lines: text holds exactly the lines that the machine put out, in order; csv and json "
      "add time,\ndevice, block and line.\nMeasurements: measurements (CSV), jsonl, dfq, dfd, dfx "
      "(Q-DAS), qif (QIF 3.0), html and pdf (a page for each part).\nDigitized points: points "
      "(CSV), dxf, "
      "stl (a solid).\n\nExamples:\n  dnc report export latest --format csv -o profile.csv\n  dnc "
      "report export lathe-1 --since 2026-11-01 --format dfq -o november.dfq");
  command.callback([&context, options] { context.status = export_report(context, *options); });
}

}  // namespace

void add_report_commands(Command app, Context& context) {
  auto group = app.add_subcommand(
      "report", "What machines print and measure: report lines, measurements, statistics");
  group.require_subcommand(1);

  auto list_command = group.add_subcommand(
      "list",
      "List runs that reported lines, newest first, and machines that printed outside runs");
  auto options = std::make_shared<ReportListCommand>();
  list_command.add_option("--machine", options->query.machine, "List only runs of this machine");
  list_command.add_option("--program", options->query.program, "List only runs of this program");
  list_command.add_option("--limit", options->limit, "List at most this many, 0 for all [20]");
  add_json_flag(list_command, context);
  run_at_server(list_command, context, options, list_reports);

  auto shown = std::make_shared<ShowCommand>();
  auto show_command = group.add_subcommand("show", "Print the report of a run, or a machine's own");
  show_command.add_option("RUN|MACHINE", shown->run, kReportHelp).required();
  show_command.add_flag(
      "--raw", shown->is_raw,
      "Print control characters unchanged, also on a terminal (otherwise as \\x1b)");
  add_json_flag(show_command, context);
  add_archive_choice(show_command, shown->archive);
  show_command.callback([&context, shown] {
    if (!shown->archive.file.empty()) {
      context.status = show_archived_report(
          context, {.archive = shown->archive, .of = shown->run, .is_raw = shown->is_raw});
    } else if (!shown->archive.sha256.empty()) {
      context.status = complain(Error{Errc::Syntax, "--sha256 is of an archive: --archive FILE"});
    } else if (auto client = context.connect()) {
      context.status = show(context, *client, *shown);
    }
  });

  add_export(group, context);
  add_measurement_commands(group, context);
  add_template_commands(group, context);
  add_report_chart_command(group, context);
  add_statistics_commands(group, context);
}

}  // namespace dripline::cli
