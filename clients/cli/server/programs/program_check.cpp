#include "clients/cli/server/programs/program_check.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/named_revision.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "protocol/base/units.hpp"

namespace dripline::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ProgramCheck {
  std::string program;
  std::string machine;
};

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::string name_of(const Json& result) {
  return fmt::format("{}@{}", printable(text_of(result.at("program"))),
                     result.at("revision").get<std::uint64_t>());
}

/// "O0200@3:4:9: warning NC0107: ..."; a called program has its own name.
std::string finding_line(const Json& result, const Json& finding) {
  const std::string called = printable(text_of(finding.at("program")));
  std::string place = fmt::format("{}:{}", called.empty() ? name_of(result) : called,
                                  finding.at("line").get<std::uint64_t>());
  if (const auto column = finding.at("column").get<std::uint64_t>(); column > 0)
    place += fmt::format(":{}", column);
  const auto times = finding.at("times").get<std::uint64_t>();
  return fmt::format("{}: {} {}: {}{}\n", place, text_of(finding.at("severity")),
                     text_of(finding.at("id")), printable(text_of(finding.at("text"))),
                     times > 1 ? fmt::format(" (met {} times)", times) : "");
}

std::string verdict(const Json& result, bool has_color) {
  const std::string outcome = text_of(result.at("outcome"));
  if (outcome == "ended") return styled("reaches its end", Style::Good, has_color);
  if (outcome == "alarm") return styled("raises an alarm", Style::Bad, has_color);
  if (outcome == "time")
    return styled("is longer than the server checks; this is its beginning", Style::Bad, has_color);
  return styled("cannot be checked to its end: " + printable(text_of(result.at("fault"))),
                Style::Bad, has_color);
}

bool is_inch(const Json& result) {
  return result.at("inch").get<bool>();
}

double length(const Json& result, double mm) {
  return is_inch(result) ? Length::mm(mm).inch() : mm;
}

std::string extent_text(const Json& result, char axis, const Json& extent) {
  const bool is_rotary = axis == 'A' || axis == 'B' || axis == 'C';
  const bool is_diameter = axis == 'X' && result.at("x_is_diameter").get<bool>();
  const auto shown = [&](std::size_t end) {
    const double value = extent.at(end).get<double>();
    return is_rotary ? value : length(result, value) * (is_diameter ? 2 : 1);
  };
  const char* const unit = is_rotary ? "degrees" : is_inch(result) ? "in" : "mm";
  return fmt::format("{:.4f} to {:.4f} {}{}", shown(0), shown(1), unit,
                     is_diameter ? " diameter" : "");
}

Details summary_of(const Json& result) {
  const char* const unit = is_inch(result) ? "in" : "mm";
  Details details;
  details.add("control", text_of(result.at("control")));
  const std::string machine = text_of(result.at("machine"));
  details.add("setup", machine.empty() ? "the control's defaults" : "of " + printable(machine));
  details.add("blocks", std::to_string(result.at("blocks").get<std::uint64_t>()));
  details.add("moves", fmt::format("{}, {:.3f} {} rapid, {:.3f} {} at feed",
                                   result.at("moves").get<std::uint64_t>(),
                                   length(result, result.at("rapid_mm").get<double>()), unit,
                                   length(result, result.at("feed_mm").get<double>()), unit));
  details.add("time", duration_text(std::round(result.at("seconds").get<double>())) +
                          " estimated, without acceleration, stops and tool changes");
  for (const auto& [axis, extent] : result.at("extents").items())
    details.add(axis, extent_text(result, axis.front(), extent));
  details.add("warnings", std::to_string(result.at("warnings").get<std::uint64_t>()));
  return details;
}

int print_check(const Context& context, const Json& result) {
  context.print(context.wants_json ? json_text(result)
                                   : program_check_text(result, context.has_color()));
  return text_of(result.at("outcome")) == "ended" ? kExitOk : kExitNo;
}

int check_program(Context& context, client::Client& client, const ProgramCheck& command) {
  const auto [name, revision] = named_revision(command.program);
  const auto answer =
      client.check({.program = name, .revision = revision, .machine = command.machine});
  if (!answer) {
    const int status = complain(answer.error());
    return status == kExitNo ? kExitUsage : status;  // 1 is for programs that do not end
  }
  return shown_json(
      client, *answer, [&](const Json& result) { return print_check(context, result); },
      " to the check");
}

}  // namespace

std::string program_check_text(const Json& result, bool has_color) {
  std::string text;
  for (const auto& finding : result.at("diagnostics")) text += finding_line(result, finding);
  if (!result.at("complete").get<bool>()) text += "(more places have warnings)\n";
  text += fmt::format("{}: {}\n", name_of(result), verdict(result, has_color));
  return text + summary_of(result).render(has_color);
}

void add_program_check(Command group, Context& context) {
  auto command = group.add_subcommand(
      "check", "Check a revision on a machine's setup: warnings, alarm, lengths, time, extents");
  auto options = std::make_shared<ProgramCheck>();
  command.add_option("PROGRAM", options->program, "NAME or NAME@REVISION (default: the latest)")
      .required()
      .type_name("PROGRAM");
  command.add_option("--machine", options->machine,
                     "Machine whose newest setup applies (default: the control's)");
  add_json_flag(command, context);
  command.footer(
      "The server interprets it for 20 seconds at most. `dnc check` does the same with files, with "
      "any setup.\n\nExit status: 0 the end was reached; 1 an alarm, or the end was not reached; 2 "
      "usage, no such revision, refused.\n\nExample:\n  dnc program check O0200@3 --machine "
      "lathe-1");
  run_at_server(command, context, options, check_program);
}

}  // namespace dripline::cli
