#include <cstdio>
#include <memory>

#include "clients/cli/commands.hpp"
#include "clients/cli/json_text.hpp"
#include "clients/cli/machine_text.hpp"
#include "clients/cli/run_reference.hpp"
#include "clients/cli/standard_output.hpp"
#include "clients/cli/value_text.hpp"
#include "clients/lib/output_file.hpp"

namespace dripline::cli {
namespace {

struct ListCommand {
  client::ReportQuery query;
  std::uint64_t limit = 20;
};

struct ExportCommand {
  std::string run, format, output;
};

int list(Context& context, const ListCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto reports = fetch_all(command.limit, [&](client::Page page) {
    client::ReportQuery query = command.query;
    query.page = page;
    return client->reports(query);
  });
  if (!reports) return complain(reports.error());
  if (context.wants_json) {
    context.print(json_list_text("reports", *reports));
    return kExitOk;
  }
  if (reports->empty()) {
    context.print("No run has reported a line yet.\n");
    return kExitOk;
  }
  Table table({{"RUN"},
               {"MACHINE"},
               {"PROGRAM"},
               {"REV", Align::Right},
               {"STATE"},
               {"LINES", Align::Right},
               {"STARTED"},
               {"ENDED"}});
  for (const auto& report : *reports) {
    table.add({short_id(report.run), report.machine, report.program,
               std::to_string(report.revision), Cell(report.state, style_of_state(report.state)),
               std::to_string(report.lines), time_text(report.started), time_text(report.ended)});
  }
  context.print(table);
  return kExitOk;
}

int print_report(client::Client& client, const std::string& run, const std::string& format) {
  StandardOutput output;
  auto printed = client.export_report(
      run, format, [&output](std::string_view bytes) { return output.write(bytes).has_value(); });
  if (output.error()) return output.complain();
  return printed ? kExitOk : complain(printed.error());
}

int show(Context& context, const std::string& reference) {
  auto client = context.connect();
  if (!client) return context.status;
  auto run = find_run(*client, reference);
  if (!run) return complain(run.error());
  if (!context.wants_json) {
    context.print(fmt::format("Report of run {}: {} revision {} on {}, {}, {}\n\n",
                              short_id(run->id), run->program, run->revision, run->machine,
                              run->state, count_text(run->outputs, "line")));
  }
  return print_report(*client, run->id, context.wants_json ? "json" : "text");
}

int export_to_file(client::Client& client, const client::Run& run, const ExportCommand& command) {
  auto file = client::OutputFile::create(command.output);
  if (!file) return complain(file.error());
  std::optional<Error> unwritten;
  auto exported = client.export_report(run.id, command.format, [&](std::string_view bytes) {
    if (auto written = file->write(bytes); !written) unwritten = written.error();
    return !unwritten;
  });
  if (unwritten) return complain(*unwritten);
  if (!exported) return complain(exported.error());
  if (auto kept = file->commit(); !kept) return complain(kept.error());
  fmt::print(stderr, "Wrote the report of run {} to {}\n", short_id(run.id), command.output);
  return kExitOk;
}

int export_report(Context& context, const ExportCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  auto run = find_run(*client, command.run);
  if (!run) return complain(run.error());
  if (!command.output.empty() && command.output != "-") {
    return export_to_file(*client, *run, command);
  }
  return print_report(*client, run->id, command.format);
}

void add_export(CLI::App& group, Context& context) {
  auto* command = group.add_subcommand("export", "Write a run's report lines for other programs");
  auto options = std::make_shared<ExportCommand>();
  options->format = "text";
  command->add_option("RUN", options->run, kRunHelp)->required();
  command->add_option("--format", options->format, "text, csv or json (default: text)")
      ->check(CLI::IsMember({"text", "csv", "json"}));
  command->add_option("-o,--output", options->output,
                      "File to write, - for standard output (default: -)");
  command->footer(
      "text holds exactly the lines that the machine put out, in order; csv and json add time, "
      "device\nand place.\n\nExample:\n  dnc report export latest --format csv -o profile.csv");
  command->callback([&context, options] { context.status = export_report(context, *options); });
}

}  // namespace

void add_report_commands(CLI::App& app, Context& context) {
  auto* group = app.add_subcommand("report", "What machines wrote: DPRNT and other output lines");
  group->require_subcommand(1);

  auto* list_command = group->add_subcommand("list", "Runs that reported lines, newest first");
  auto options = std::make_shared<ListCommand>();
  list_command->add_option("--machine", options->query.machine, "Only of this machine");
  list_command->add_option("--program", options->query.program, "Only of this program");
  list_command->add_option("--limit", options->limit, "At most this many, 0 for all (default: 20)");
  add_json_flag(*list_command, context);
  list_command->callback([&context, options] { context.status = list(context, *options); });

  auto shown = std::make_shared<std::string>();
  auto* show_command = group->add_subcommand("show", "Print a run's report");
  show_command->add_option("RUN", *shown, kRunHelp)->required();
  add_json_flag(*show_command, context);
  show_command->callback([&context, shown] { context.status = show(context, *shown); });

  add_export(*group, context);
}

}  // namespace dripline::cli
