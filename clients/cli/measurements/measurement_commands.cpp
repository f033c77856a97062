#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/measurements/archived_listing.hpp"
#include "clients/cli/measurements/export_formats.hpp"
#include "clients/cli/measurements/measurement_text.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;

struct MeasurementsCommand {
  client::MeasurementQuery query;
  std::string output;
  ArchiveChoice archive;
  bool csv = false;
};

struct DeriveCommand {
  std::string run, name;
  std::optional<std::uint64_t> version;
};

/// `latest` and beginnings of ids become ids.
std::optional<int> resolve_run(client::Client& client, std::string& run) {
  if (run.empty()) return std::nullopt;
  const auto found = find_run(client, run);
  if (!found) return complain(found.error());
  run = found->id;
  return std::nullopt;
}

/// All of them, not a listing.
bool is_export(const MeasurementsCommand& command) {
  return command.csv || !command.output.empty();
}

/// What would be ignored is refused by its name.
Result<void> check_output(const Context& context, const MeasurementsCommand& command) {
  if (command.csv && context.wants_json) return fail(Errc::Syntax, "--csv and --json: give one");
  if (is_export(command) && command.query.newest_first) {
    return fail(Errc::Syntax,
                "--newest is for the listing: --csv and --output write all, oldest first");
  }
  if (!command.archive.sha256.empty() && command.archive.file.empty())
    return fail(Errc::Syntax, "--sha256 is of an archive: --archive FILE");
  return {};
}

int archived_measurements(Context& context, const MeasurementsCommand& command) {
  MeasurementChoice choice{
      .file = {}, .query = command.query, .tool = {}, .archive = command.archive};
  if (!is_export(command)) return list_archived_measurements(context, choice);
  MeasurementExport request;
  request.choice = std::move(choice);
  request.format = command.csv ? "measurements" : "jsonl";
  request.output = command.output;
  return export_measurements(context, request);
}

int measurements(Context& context, client::Client& client, const MeasurementsCommand& command) {
  client::MeasurementQuery query = command.query;
  if (const auto status = resolve_run(client, query.run)) return *status;
  if (is_export(command)) {
    return save_content(command.output, [&](const ContentSink& sink) {
      return client.export_measurements(query, command.csv ? "csv" : "jsonl", sink);
    });
  }
  return print_listing(context, client, client.measurements(query),
                       {"measurements", "Nothing was measured.\n", measurement_table});
}

int parts(Context& context, client::Client& client, const MeasurementsCommand& command) {
  client::MeasurementQuery query = command.query;
  if (const auto status = resolve_run(client, query.run)) return *status;
  return print_listing(context, client, client.parts(query),
                       {"parts", "No part was measured.\n", part_table});
}

int findings(Context& context, client::Client& client, const MeasurementsCommand& command) {
  client::MeasurementQuery query = command.query;
  if (const auto status = resolve_run(client, query.run)) return *status;
  return print_listing(
      context, client, client.report_findings(query),
      {"findings", "Every line that a template is asked about was understood.\n", finding_table});
}

int derive(Context& context, client::Client& client, const DeriveCommand& command) {
  std::string run = command.run;
  if (const auto status = resolve_run(client, run)) return *status;
  const auto answer = client.derive_measurements(run, command.name, command.version);
  return print_answer(context, client, answer, [&](const ordered_json& shown) {
    context.print(part_table(shown.at("parts")));
  });
}

void add_choice(Command command, const std::shared_ptr<MeasurementsCommand>& options) {
  command.add_option("--run", options->query.run,
                     "List only this run: its id, the beginning of it, or latest");
  command.add_option("--machine", options->query.machine, "List only this machine");
  command.add_option("--limit", options->query.limit, "List at most this many, up to 1000 [100]")
      .check(in_range(1, 1000));
}

}  // namespace

void add_measurement_commands(Command report, Context& context) {
  auto listed = report.add_subcommand("measurements", "List measured values, oldest first");
  auto options = std::make_shared<MeasurementsCommand>();
  add_choice(listed, options);
  listed.add_option("--characteristic", options->query.characteristic,
                    "List only this characteristic");
  listed.add_option("--since", options->query.since,
                    "List only what is from this time on, UTC: 2026-11-21 or "
                    "2026-11-21T07:40:06Z");
  listed.add_option("--until", options->query.until, "List only what is earlier than this time");
  listed.add_option("--verdict", options->query.verdict, "List only this verdict")
      .check(one_of({"good", "unknown", "rework", "scrap"}));
  listed.add_flag("--newest", options->query.newest_first, "List the newest first");
  listed.add_flag("--superseded", options->query.with_superseded,
                  "List also what was replaced when a run was derived again");
  listed.add_flag("--csv", options->csv, "Write all of them as CSV, without a limit");
  listed.add_option("-o,--output", options->output,
                    "Write all of them to this file, - for standard output, as JSON Lines or with "
                    "--csv as CSV");
  add_json_flag(listed, context);
  listed.footer(
      "Example:\n  dnc report measurements --machine lathe-1 --characteristic D12 --since "
      "2026-11-01 --csv -o d12.csv");
  add_archive_choice(listed, options->archive);
  listed.callback([&context, options] {
    if (const auto good = check_output(context, *options); !good) {
      complain(good.error());
      context.status = kExitUsage;
    } else if (!options->archive.file.empty()) {
      context.status = archived_measurements(context, *options);
    } else if (auto client = context.connect()) {
      context.status = measurements(context, *client, *options);
    }
  });

  auto part_list = report.add_subcommand("parts", "List measured parts with their verdicts");
  auto part_options = std::make_shared<MeasurementsCommand>();
  add_choice(part_list, part_options);
  part_list.add_option("--verdict", part_options->query.verdict, "List only this verdict")
      .check(one_of({"good", "unknown", "rework", "scrap"}));
  part_list.add_flag("--superseded", part_options->query.with_superseded,
                     "List also what was replaced when a run was derived again");
  add_json_flag(part_list, context);
  run_at_server(part_list, context, part_options, parts);

  auto found = report.add_subcommand(
      "findings", "List report lines that were not understood, missing, doubled or out of order");
  auto found_options = std::make_shared<MeasurementsCommand>();
  add_choice(found, found_options);
  add_json_flag(found, context);
  run_at_server(found, context, found_options, findings);

  auto again =
      report.add_subcommand("derive", "Derive a run's measurements from its report lines again");
  auto derived = std::make_shared<DeriveCommand>();
  again.add_option("RUN", derived->run, "Run: its id, the beginning of it, or latest").required();
  again.add_option("--template", derived->name,
                   "Use this template alone [those that are assigned]");
  again.add_option("--version", derived->version, "Use this version of it [the newest]");
  add_json_flag(again, context);
  again.footer(
      "The measurements that were derived before are kept with the version of their template, and "
      "listed by --superseded. A run of which an archive has records is refused.\n\nExample:\n  "
      "dnc report derive "
      "latest --template bore");
  run_at_server(again, context, derived, derive);
}

}  // namespace dripline::cli
