#include "clients/cli/server/programs/program_diff.hpp"

#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/comparison_text.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/named_revision.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

struct ProgramDiff {
  std::string first, second;
  bool by_motion = false, normalized = false;
  client::ComparisonQuery query;
};

/// 1 is for programs that differ.
int status_of_failure(const client::Failure& failure) {
  const int status = complain(failure);
  return status == kExitNo ? kExitUsage : status;
}

std::string revision_name(const nlohmann::ordered_json& revision) {
  return fmt::format("{}@{}", revision.at("program").get<std::string>(),
                     revision.at("revision").get<std::uint64_t>());
}

int print_comparison(const Context& context, const nlohmann::ordered_json& result) {
  const ComparedNames names{revision_name(result.at("first")), revision_name(result.at("second"))};
  const int written =
      context.wants_json
          ? write_to("-", json_text(result))
          : write_to("-", comparison_text(result, names, context.has_color()), Content::Text);
  return written == kExitOk ? comparison_status(result) : written;
}

int diff_programs(Context& context, client::Client& client, const ProgramDiff& command) {
  client::ComparisonQuery query = command.query;
  const NamedRevision first = named_revision(command.first);
  const NamedRevision second =
      named_revision(command.second.empty() ? first.program : command.second);
  query.first = first.program;
  query.first_revision = first.revision;
  query.second = second.program;
  query.second_revision = second.revision;
  query.by = command.by_motion ? "motion" : command.normalized ? "normalized" : "text";
  const auto answer = client.compare(query);
  if (!answer) return status_of_failure(answer.error());
  return shown_json(
      client, *answer,
      [&](const nlohmann::ordered_json& result) { return print_comparison(context, result); },
      " to the comparison");
}

}  // namespace

void add_program_diff(Command group, Context& context) {
  auto command = group.add_subcommand(
      "diff", "Compare two revisions: their text, or what they do on a machine's setup");
  auto options = std::make_shared<ProgramDiff>();
  command.add_option("FIRST", options->first, "As it was: NAME or NAME@REVISION")
      .required()
      .type_name("PROGRAM");
  command
      .add_option("SECOND", options->second,
                  "As it is: NAME or NAME@REVISION (default: the latest of FIRST)")
      .type_name("PROGRAM");
  auto normalized =
      command.add_flag("--normalized", options->normalized,
                       "Ignore N numbers, comments, blanks, case and forms of numbers");
  command
      .add_flag("--motion", options->by_motion,
                "Interpret both and compare what they do: path, feeds, speeds, tools, outputs")
      .excludes(normalized);
  command.add_option("--machine", options->query.machine,
                     "Machine whose newest setup applies to motion (default: the control's)");
  command
      .add_option("--tolerance", options->query.tolerance,
                  "Distance of two paths that are the same, mm [0.001]")
      .check(in_range(0.0, 1000.0));
  command.add_option("--unified", options->query.context, "Lines of context around a change [3]")
      .type_name("N")
      .check(in_range(0u, 100u));
  add_json_flag(command, context);
  command.footer(
      "The last line has the class of the edit: comment, same motion, feed and speed, offsets, "
      "geometry or other.\nWhat the comparison depends on (an alarm, a probe, a prompt, a variable "
      "from outside, a block skip) is\nlisted as a condition. `dnc diff` compares files, with any "
      "setup.\n\nExit status: 0 the same, 1 different, or the same on conditions only, 2 usage, no "
      "such revision, refused.\n\nExample:\n  dnc program diff O0200@3 O0200@4 --motion --machine "
      "lathe-1");
  run_at_server(command, context, options, diff_programs);
}

}  // namespace dripline::cli
