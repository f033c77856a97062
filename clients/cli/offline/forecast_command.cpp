#include <fmt/format.h>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/table.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/tools/offline/forecast.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "protocol/wire/line_settings.hpp"

namespace dripline::cli {
namespace {

using interpreter::FeedLine;
using interpreter::ForecastResult;
using interpreter::Units;

struct ForecastCommand {
  OfflineCommand program;
  std::string line;  ///< a template or a short form
  double characters_per_second = 0;
  double start_ms = -1;
  std::uint64_t buffer = 0;
  std::size_t limit = 20;
};

/// The line by its template ("tnc155"), its short form ("9600e72"), or plain characters a second.
Result<FeedLine> line_of(const ForecastCommand& command) {
  FeedLine line;
  line.buffer = command.buffer;
  if (command.line.empty() && command.characters_per_second <= 0) {
    return fail(Errc::Syntax, "expected --line or --cps: how fast do the blocks come?");
  }
  if (!command.line.empty()) {
    wire::LineSettings settings;
    if (const auto found = wire::find_template(command.line)) {
      settings = (*found)->settings;
    } else if (const auto done = wire::apply_short_form(command.line, settings); !done) {
      return fail(Errc::NotFound, "--line {}: neither a template nor a short form such as 9600e72",
                  command.line);
    }
    const bool is_reader = settings.flow == wire::Flow::TapeReader;
    line.characters_per_second =
        is_reader ? settings.reader.characters_per_second : wire::characters_per_second(settings);
    constexpr double kReaderStart = 0.010;
    if (is_reader) line.start_seconds = kReaderStart;
  }
  if (command.characters_per_second > 0) line.characters_per_second = command.characters_per_second;
  if (command.start_ms >= 0) line.start_seconds = command.start_ms / 1000;
  return line;
}

std::string unit_name(Units units) {
  return units == Units::Inch ? "in" : "mm";
}
double in_units(Length length, Units units) {
  return units == Units::Inch ? length.inch() : length.mm();
}

struct Report {
  const ForecastResult& result;
  FeedLine line;
  Units units;
  std::size_t limit;  ///< of the blocks that are listed
  std::function<std::string(interpreter::ProgramIndex)> file_of;
};

std::string report_text(const Report& report, bool has_color) {
  const auto& [result, line, units, limit, file_of] = report;
  std::string text =
      fmt::format("{} blocks at {:g} characters a second: moves {}, waits {}\n", result.blocks,
                  line.characters_per_second, duration_text(result.move_seconds),
                  result.wait_seconds < 1 ? fmt::format("{:.2f} s", result.wait_seconds)
                                          : duration_text(result.wait_seconds));
  if (result.starved == 0) return text + "No block starves.\n";
  const std::string unit = unit_name(units);
  text +=
      fmt::format("{} of them end before the next one has arrived; the axes wait. The longest:\n\n",
                  result.starved);
  Table table({right("LINE"), right("N"), right("MOVES " + unit), right("IN s"), right("WAITS s"),
               right("FOR CHARACTERS"), right("SUSTAINABLE FEED " + unit + "/min")});
  for (std::size_t i = 0; i < result.worst.size() && i < limit; ++i) {
    const auto& block = result.worst[i];
    const bool is_called = block.program != interpreter::kMainProgram;
    table.add({(is_called ? file_of(block.program) + ":" : "") + std::to_string(block.line),
               block.sequence < 0 ? "-" : std::to_string(block.sequence),
               fmt::format("{:.4f}", in_units(block.moved, units)),
               fmt::format("{:.3f}", block.move_seconds), fmt::format("{:.3f}", block.wait_seconds),
               std::to_string(block.characters),
               fmt::format("{:.1f}", in_units(block.feed_that_would_do, units))});
  }
  return text + table.render(has_color);
}

nlohmann::ordered_json report_json(const Report& report) {
  const auto& [result, line, units, limit, file_of] = report;
  nlohmann::ordered_json starved = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < result.worst.size() && i < limit; ++i) {
    const auto& block = result.worst[i];
    nlohmann::ordered_json entry{{"line", block.line},
                                 {"moved", in_units(block.moved, units)},
                                 {"move_seconds", block.move_seconds},
                                 {"wait_seconds", block.wait_seconds},
                                 {"characters", block.characters},
                                 {"feed_that_would_do", in_units(block.feed_that_would_do, units)},
                                 {"file", file_of(block.program)}};
    if (block.sequence >= 0) entry["block"] = block.sequence;
    starved.push_back(std::move(entry));
  }
  return {{"blocks", result.blocks},
          {"starved", result.starved},
          {"characters_per_second", line.characters_per_second},
          {"buffer", line.buffer},
          {"move_seconds", result.move_seconds},
          {"wait_seconds", result.wait_seconds},
          {"units", unit_name(units)},
          {"worst", std::move(starved)}};
}

int forecast(Context& context, const ForecastCommand& command) {
  const auto line = line_of(command);
  if (!line) return complain(line.error());
  auto program = OfflineProgram::open(command.program);
  if (!program) return complain(program.error());
  auto source = program->source();
  interpreter::Forecast sink(*line, program->text().size(), program->setup().start, {},
                             program->machine());
  const auto outcome = interpreter::run_offline(program->dialect(), program->setup(), source, sink);
  if (!outcome) return complain_offline(outcome.error());
  const ForecastResult& result = sink.finish();
  const Report report{result, *line, sink.summary().units, command.limit,
                      [&](auto called) { return program->file_of(source, called); }};
  context.print(context.wants_json ? json_text(report_json(report))
                                   : report_text(report, context.has_color()));
  if (outcome->alarm) {
    return complain(Error{
        Errc::Syntax, fmt::format("the program alarms in {}: {}",
                                  program->alarm_place(source, *outcome), outcome->alarm->text)});
  }
  return result.starved == 0 ? kExitOk : kExitNo;
}

}  // namespace

void add_forecast_command(Command app, Context& context) {
  auto command = app.add_subcommand(
      "forecast", "Find the blocks that would starve on a slow line or tape reader");
  auto options = std::make_shared<ForecastCommand>();
  add_offline_options(command, options->program);
  command.add_option(
      "--line", options->line,
      "The line: a port template (dnc port templates) or a short form, e.g. 9600e72");
  command
      .add_option("--cps", options->characters_per_second,
                  "Characters per second, instead of --line")
      .check(positive_number());
  command.add_option("--start-ms", options->start_ms,
                     "Start time of a reader before each block [tape readers 10, else 0]");
  command.add_option("--buffer", options->buffer,
                     "Characters the control buffers [0: the next block]");
  command.add_option("--limit", options->limit, "Blocks to list [20]");
  add_json_flag(command, context);
  command.footer(
      "No server is needed. Times have acceleration where the setup's [machine] states it "
      "(deploy/docs/setup-format.md),\nnot that of axes that wait for a block.\n\nExit status: 0 "
      "no block starves, 1 some "
      "do or the program alarms, 2 usage.\n\nExample:\n  dnc forecast --control tektronix-1704 "
      "--line tektronix1704 part.nc\n  dnc forecast --line 4800e71 --buffer 4096 surface.nc");
  command.callback([&context, options] { context.status = forecast(context, *options); });
}

}  // namespace dripline::cli
