#include "clients/cli/offline/motion_conversion.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/lib/output_file.hpp"
#include "clients/tools/post/conversion.hpp"

namespace dripline::cli {
namespace {

using comparison::Condition;
using comparison::MotionResult;
using nlohmann::ordered_json;
using post::WrittenProgram;

constexpr std::size_t kMaxListedPlaces = 5;
constexpr std::size_t kMaxLine = 200;

constexpr std::array kOptions{"--control",   "--to-setup",          "--units",
                              "--name",      "--tolerance",         "--arcs-as-lines",
                              "--as-set-up", "--keep-compensation", "--json"};

/// What the adaptation changed: a member of the JSON, and the words of a note.
struct Change {
  std::uint64_t post::AdaptationCounts::*count;
  const char* member;
  const char* words;
};
constexpr std::array<Change, 16> kChanges{{
    {&post::AdaptationCounts::short_moves, "short_moves",
     "moves left out that are shorter than a step of the target"},
    {&post::AdaptationCounts::split_arcs, "split_arcs", "arcs written as several"},
    {&post::AdaptationCounts::straightened_arcs, "straightened_arcs",
     "arcs written as their chord, which is within half a step of them"},
    {&post::AdaptationCounts::arcs_as_lines, "arcs_as_lines", "arcs written as lines"},
    {&post::AdaptationCounts::rounded_feeds, "rounded_feeds", "feeds rounded"},
    {&post::AdaptationCounts::rounded_speeds, "rounded_speeds", "spindle speeds rounded"},
    {&post::AdaptationCounts::rounded_dwells, "rounded_dwells", "dwells rounded"},
    {&post::AdaptationCounts::rounded_leads, "rounded_leads", "leads of threads rounded"},
    {&post::AdaptationCounts::inverse_time, "inverse_time_feeds",
     "inverse time feeds written per minute"},
    {&post::AdaptationCounts::exact_stops, "exact_stops", "exact stops not written"},
    {&post::AdaptationCounts::messages, "messages",
     "messages to the operator that are comments now, if the target has them"},
    {&post::AdaptationCounts::prompts, "prompts", "questions answered from the setup"},
    {&post::AdaptationCounts::tool_change_stops, "tool_change_stops",
     "waits for a tool changed by hand not written"},
    {&post::AdaptationCounts::spindle_restarts, "spindle_restarts",
     "starts of the spindle after a tool change, which stops it"},
    {&post::AdaptationCounts::operator_actions, "operator_actions",
     "moves of Z, switches of spindle and coolant and stops left to the operator"},
    {&post::AdaptationCounts::assumed_tools, "assumed_tools",
     "tools asked for that the program does not call"},
}};

std::string_view reason_of(Condition::Kind kind) {
  switch (kind) {
    case Condition::Kind::Alarm:
      return "an alarm";
    case Condition::Kind::Fault:
      return "it could not be interpreted";
    case Condition::Kind::Probe:
      return "a probing move";
    case Condition::Kind::Prompt:
      return "a question to the operator";
    case Condition::Kind::Input:
      return "an input";
    case Condition::Kind::Clock:
      return "the control's clock";
    case Condition::Kind::Variable:
      return "a variable whose value may come from outside";
    case Condition::Kind::BlockSkip:
      return "a block that a switch of the panel skips";
    case Condition::Kind::Start:
      return "the position from which the program starts";
  }
  return {};
}

/// The line of that number: offsets are those of a text with other radii, where there is one.
std::string line_of(std::string_view text, std::uint64_t number) {
  for (std::uint64_t line = 1; line < number; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, std::min(kMaxLine, text.find_first_of("\r\n")));
  return std::string(text);
}

/// A conversion with all that its messages need.
struct Work {
  const MotionConversion& command;
  const post::Target& target;
  const OfflineProgram& program;
  interpreter::MemorySource& source;

  std::string place_of(const comparison::Place& place) const {
    return program.place_of(source, place.program, place.line);
  }
};

int refuse_conversion(const Work& work, const post::NotConverted& refusal) {
  if (is_interrupted()) {
    print_error("dnc: the conversion was ended; nothing was written\n");
    return kExitInterrupted;
  }
  std::string place = work.command.source.file;
  if (refusal.origin)
    place +=
        ": " + work.program.place_of(work.source, refusal.origin->program, refusal.origin->line);
  complain(Error{refusal.code, place + ": " + refusal.what});
  const bool is_of_user = refusal.code == Errc::Io || refusal.code == Errc::NotFound;
  return is_of_user ? kExitUsage : kExitNo;
}

void print_side(const char* name, const std::string& place, const std::string& action,
                const std::string& line) {
  print_error("  {}, {}: {}\n      {}\n", name, place, action.empty() ? "nothing here" : action,
              line);
}

int complain_of_difference(const Work& work, const MotionResult& result, std::string_view text) {
  const std::string name(work.target.name);
  print_error(
      "dnc: {}: what would be written for {} does not do the same at {} places; nothing was "
      "written\n",
      work.command.source.file, name, result.place_count);
  for (std::size_t i = 0; i < std::min(result.places.size(), kMaxListedPlaces); ++i) {
    const auto& place = result.places[i];
    std::string what;
    for (std::size_t k = 0; k < comparison::kDifferenceCount; ++k) {
      const auto difference = static_cast<comparison::Difference>(k);
      if (!place.differences.has(difference)) continue;
      what += (what.empty() ? "" : ", ") + std::string(word_of(difference));
    }
    if (place.distance > 0) what += fmt::format(", {:.6f} mm apart", place.distance);
    print_error(" {}\n", what);
    const bool is_main = place.first.program == interpreter::kMainProgram;
    print_side(work.command.source.file.c_str(), work.place_of(place.first), place.first_text,
               is_main ? line_of(work.program.text(), place.first.line) : std::string());
    print_side(name.c_str(), fmt::format("line {}", place.second.line), place.second_text,
               line_of(text, place.second.line));
  }
  if (work.command.keeps_compensation) {
    print_error(
        "dnc: compensation cannot be kept here: with one and the same radius both controls "
        "lead the tool along other paths; without --keep-compensation the path is written\n");
  } else if (!work.command.is_as_set_up) {
    print_error(
        "dnc: it was written from a start {} mm beside that of the setup, so that a program "
        "that depends on its start shows; --as-set-up writes it for that of the setup\n",
        comparison::kStartShift);
  }
  return kExitNo;
}

int complain_of_condition(const Work& work, const Condition& condition) {
  const std::string place = condition.is_second
                                ? fmt::format("{} line {}", work.target.name, condition.place.line)
                                : work.place_of(condition.place);
  const bool can_be_accepted = !condition.is_second && condition.kind != Condition::Kind::Alarm &&
                               condition.kind != Condition::Kind::Fault &&
                               condition.kind != Condition::Kind::Probe;
  complain(Error{
      Errc::Unsupported,
      fmt::format("{}: {}: what it does depends on {}{}{}; nothing was written{}",
                  work.command.source.file, place, reason_of(condition.kind),
                  condition.text.empty() ? "" : ": ", condition.text,
                  can_be_accepted ? " (--as-set-up writes what it does with its setup)" : "")});
  return kExitNo;
}

ordered_json summary_json(const Work& work, const WrittenProgram& written,
                          const MotionResult& result) {
  ordered_json changes = ordered_json::object();
  for (const Change& change : kChanges) changes[change.member] = written.adapted.*change.count;
  ordered_json conditions = ordered_json::array();
  for (const Condition& condition : result.conditions) {
    conditions.push_back({{"kind", word_of(condition.kind)},
                          {"line", condition.place.line},
                          {"called", condition.place.program != interpreter::kMainProgram},
                          {"text", condition.text}});
  }
  ordered_json radii = ordered_json::array();
  for (const auto& [number, radius] : written.compensation.radii) {
    radii.push_back(
        {{"number", number}, {"radius", radius}, {"other_radius", radius * post::kOtherRadius}});
  }
  return {{"input", work.command.source.file},
          {"output", work.command.output},
          {"from", work.program.dialect().name},
          {"to", work.target.name},
          {"number", written.head.number},
          {"units", post::unit_name(written.head.units)},
          {"blocks", written.written.blocks},
          {"moves", written.written.moves},
          {"arcs", written.written.arcs},
          {"other_actions", written.written.actions},
          {"comments", written.written.comments},
          {"comments_left_out", written.written.comments_left_out},
          {"proved", {{"actions", result.first_actions}, {"tolerance", written.tolerance}}},
          {"kept_radii", std::move(radii)},
          {"changes", std::move(changes)},
          {"conditions", std::move(conditions)}};
}

std::string summary_text(const Work& work, const WrittenProgram& written,
                         const MotionResult& result) {
  const auto& counts = written.written;
  return fmt::format(
      "Converted {} ({}) -> {} ({}, program {}, {}): {} blocks\nProved: {} moves and {} other "
      "actions, {} in all, do the same within {:.6g} mm\n",
      work.command.source.file, work.program.dialect().name, work.command.output, work.target.name,
      written.head.number, post::unit_name(written.head.units), counts.blocks, counts.moves,
      result.first_actions - std::min(result.first_actions, counts.moves), result.first_actions,
      written.tolerance);
}

void print_notes(const Work& work, const WrittenProgram& written, const MotionResult& result) {
  for (const Change& change : kChanges) {
    const std::uint64_t count = written.adapted.*change.count;
    if (count > 0) print_error("dnc: note: {} {}\n", count, change.words);
  }
  if (written.written.comments_left_out > 0) {
    print_error("dnc: note: {} comments left out: {} has none\n", written.written.comments_left_out,
                work.target.name);
  }
  for (const auto& [number, radius] : written.compensation.radii) {
    print_error(
        "dnc: note: compensation kept by radius {} of the control: proved with {:g} mm and "
        "with {:g} mm\n",
        number, radius, radius * post::kOtherRadius);
  }
  for (const Condition& condition : result.conditions) {
    print_error("dnc: note: {}: holds for this setup alone: {}{}{}\n",
                work.place_of(condition.place), reason_of(condition.kind),
                condition.text.empty() ? "" : ": ", condition.text);
  }
}

/// The proved file under its name, or its text on standard output.
int deliver(const Work& work, client::OutputFile& file, std::string_view text) {
  if (work.command.output == "-") return write_to("-", text);
  if (auto done = file.commit(); !done) return complain(done.error());
  return kExitOk;
}

int convert_program(Context& context, const Work& work, const post::ConversionOptions& options,
                    client::OutputFile& file) {
  const post::SourceProgram source{work.program.dialect(), work.program.setup(), work.source,
                                   work.program.text()};
  const auto written = post::write_program(source, work.target, options,
                                           [&](std::string_view text) { return file.write(text); });
  if (!written) return refuse_conversion(work, written.error());
  const auto result_file = MappedFile::open(file.temporary_path());
  if (!result_file) return complain(result_file.error());
  interpreter::MemorySource text(result_file->text());
  const auto result = post::prove(source, *written, text, options);
  if (!result) return refuse_conversion(work, {result.error().code, result.error().what, {}});
  if (!result->is_same) return complain_of_difference(work, *result, result_file->text());
  if (const auto* condition = post::objection(*result, options))
    return complain_of_condition(work, *condition);
  if (const int status = deliver(work, file, result_file->text()); status != kExitOk) return status;
  if (context.wants_json) {
    context.print(json_text(summary_json(work, *written, *result)));
    return kExitOk;
  }
  print_notes(work, *written, *result);
  if (work.command.output != "-") context.print(summary_text(work, *written, *result));
  return kExitOk;
}

Result<post::ConversionOptions> options_of(const MotionConversion& command,
                                           const post::Target& target) {
  post::ConversionOptions options;
  const auto dialect = interpreter::find_dialect(target.dialect);
  if (!dialect) return fail(dialect.error());
  auto setup = read_setup(command.target_setup, **dialect);
  if (!setup) return fail(setup.error());
  options.target_setup = *std::move(setup);
  if (!command.units.empty())
    options.units =
        command.units == "in" ? interpreter::Units::Inch : interpreter::Units::Millimeter;
  if (command.name) options.name = static_cast<std::int64_t>(*command.name);
  options.tolerance = command.tolerance;
  options.chord = command.chord;
  options.is_as_set_up = command.is_as_set_up;
  options.keeps_compensation = command.keeps_compensation;
  options.is_to_stop = [] { return is_interrupted(); };
  return options;
}

}  // namespace

std::vector<std::string> motion_targets() {
  std::vector<std::string> names;
  for (const auto& target : post::targets()) names.emplace_back(target.name);
  return names;
}

bool is_motion_target(std::string_view name) {
  const auto names = motion_targets();
  return std::ranges::find(names, name) != names.end();
}

void add_motion_options(Command command, MotionConversion& options) {
  constexpr auto kGroup = "For another control";
  command
      .add_option("--control", options.source.control,
                  "Control of IN (default: detected from the text and the file name)")
      .group(kGroup);
  command
      .add_option("--to-setup", options.target_setup,
                  "TOML file: setup of the machine that the program is for (tools, work offset, "
                  "options of the control)")
      .group(kGroup);
  command.add_option("--units", options.units, "Write mm or in (default: as IN)")
      .check(one_of({"mm", "in"}))
      .group(kGroup);
  command.add_option("--name", options.name, "Number of the program (default: that of IN, or 1)")
      .group(kGroup);
  command
      .add_option("--tolerance", options.tolerance,
                  "Distance of two paths that are the same, mm (default: a step of the control)")
      .check(in_range(0.0, 1.0))
      .group(kGroup);
  command
      .add_option("--arcs-as-lines", options.chord,
                  "Write arcs that the control does not have as lines within this distance, mm")
      .check(in_range(0.0001, 1.0))
      .group(kGroup);
  command
      .add_flag("--as-set-up", options.is_as_set_up,
                "Also write what depends on the setup: position at the start, variables, answers, "
                "inputs, block skip")
      .group(kGroup);
  command
      .add_flag("--keep-compensation", options.keeps_compensation,
                "Write contours as programmed, with the control's words of cutter compensation, "
                "instead of the path of the tool; proved with the radii of the setup, and with "
                "others")
      .group(kGroup);
}

std::string given_motion_option(const Command& command) {
  for (const char* name : kOptions) {
    if (command.get_option(name).count() > 0) return name;
  }
  return {};
}

int convert_by_motion(Context& context, const MotionConversion& command) {
  const auto target = post::find_target(command.to);
  if (!target) {
    complain(target.error());
    return kExitNo;
  }
  if (command.output.empty())
    return complain(Error{Errc::Syntax, "convert needs -o FILE (or -o -)"});
  if (command.output == "-" && context.wants_json)
    return complain(Error{Errc::Syntax,
                          "--json needs -o FILE: standard output has one of "
                          "the program and its summary"});
  auto program = OfflineProgram::open(command.source);
  if (!program) return complain(program.error());
  const auto options = options_of(command, **target);
  if (!options) return complain(options.error());
  const std::string path = command.output == "-"
                               ? (std::filesystem::temp_directory_path() / "dnc-convert").string()
                               : command.output;
  auto file = client::OutputFile::create(path);
  if (!file) return complain(file.error());
  catch_interrupts();
  auto source = program->source();
  return convert_program(context, {command, **target, *program, source}, *options, *file);
}

}  // namespace dripline::cli
