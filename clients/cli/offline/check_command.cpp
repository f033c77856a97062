#include <fmt/core.h>
#include <algorithm>
#include <charconv>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/offline/check_report.hpp"
#include "clients/cli/offline/offline_program.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/progress.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/tools/offline/check_summary.hpp"
#include "clients/tools/offline/offline_run.hpp"

namespace dripline::cli {
namespace {

struct CheckCommand : OfflineCommand {
  std::string to;  ///< empty: the whole program
  bool lists_stops = false;
};

/// Shows how far into the text the check has come, looking at the clock only now and then.
class CheckProgress final : public interpreter::EventSink {
 public:
  CheckProgress(Progress& progress, std::uint64_t total) : progress_(progress), total_(total) {}

  void on_block_end(const interpreter::Origin& origin) override {
    if (++blocks_ % kEvery != 0 || origin.program != interpreter::kMainProgram) return;
    progress_.update(origin.offset, total_);
  }

 private:
  static constexpr std::uint64_t kEvery = 4096;
  Progress& progress_;
  std::uint64_t total_;
  std::uint64_t blocks_ = 0;
};

/// "120" and "N120": a block number; "L7": a line.
Result<interpreter::OfflineLimits> limits_of(const std::string& to) {
  interpreter::OfflineLimits limits;
  if (to.empty()) return limits;
  const bool is_line = to.front() == 'L' || to.front() == 'l';
  const std::size_t digits = is_line || to.front() == 'N' || to.front() == 'n' ? 1 : 0;
  std::uint32_t number = 0;
  const char* end = to.data() + to.size();
  const auto read = std::from_chars(to.data() + digits, end, number);
  if (read.ec != std::errc{} || read.ptr != end) {
    return fail(Errc::Syntax, "--to {}: expected a block number as 120 or N120, or a line as L7",
                to);
  }
  if (is_line) {
    limits.stop = interpreter::StopPoint{.sequence = {}, .line = number};
  } else {
    limits.stop = interpreter::StopPoint{.sequence = number, .line = {}};
  }
  return limits;
}

/// Checks the program against the control's own memory: warnings, or the alarm where the setup says
/// that it keeps its programs. False: it would not take the program.
Result<bool> check_memory(const OfflineProgram& program, interpreter::EventSink& sink) {
  if (program.dialect().check_memory == nullptr) return true;
  auto source = program.source();
  const auto verdict = program.dialect().check_memory(program.setup(), source);
  if (!verdict) return fail(verdict.error());
  for (const auto& refused : verdict->refused) {
    if (!verdict->is_binding) {
      sink.on_warning({{}, refused});
      continue;
    }
    sink.on_program({.control = program.dialect().name, .name = {}});
    sink.on_alarm({{}, refused});
    return false;
  }
  return true;
}

/// Runs the program into `sink`, with a progress bar on a terminal.
Result<interpreter::OfflineOutcome> run(const OfflineProgram& program, const CheckCommand& command,
                                        interpreter::MemorySource& source,
                                        interpreter::EventSink& sink, const Clock& clock) {
  auto limits = limits_of(command.to);
  if (!limits) return fail(limits.error());
  limits->reads_on = true;
  const auto fits = check_memory(program, sink);
  if (!fits) return fail(fits.error());
  if (!*fits) return interpreter::OfflineOutcome{};
  LiveArea area = LiveArea::on_stderr();
  if (!area.is_live()) {
    return interpreter::run_offline(program.dialect(), program.setup(), source, sink, *limits);
  }
  Progress bar(area, clock, command.file);
  CheckProgress progress(bar, program.text().size());
  interpreter::EventTee both(sink, progress);
  return interpreter::run_offline(program.dialect(), program.setup(), source, both, *limits);
}

/// The program went to its end past the block that was to be looked at.
int never_there(const CheckCommand& command) {
  print_error("dnc: {}: block {} is not reached before the end of the program\n", command.file,
              command.to);
  return kExitNo;
}

/// The text of a block up to its line's end.
std::string block_text(interpreter::MemorySource& source, const interpreter::Origin& origin) {
  constexpr std::size_t kMaxShown = 200;
  const auto window = source.fetch(origin.program, origin.offset, kMaxShown);
  const std::string_view text = window.text.substr(0, window.text.find_first_of("\r\n"));
  return std::string(text.substr(0, std::min(text.size(), kMaxShown)));
}

/// Who listens to the run.
struct CheckSinks {
  CheckSinks(const interpreter::Position& start, const interpreter::MachineData& machine)
      : summary(start, {}, machine), state(start) {}

  interpreter::CheckSummary summary;
  interpreter::MachineState state;
  interpreter::StopList stops;
  interpreter::EventTee with_stops{summary, stops};
  interpreter::EventTee all{with_stops, state};

  /// Only the sinks that are needed: every sink costs time at every event.
  interpreter::EventSink& of(const CheckCommand& command) {
    if (!command.to.empty()) return all;
    return command.lists_stops ? static_cast<interpreter::EventSink&>(with_stops) : summary;
  }
};

CheckReport report_of(const OfflineProgram& program, interpreter::MemorySource& source,
                      const CheckSinks& sinks, const CheckCommand& command) {
  CheckReport report;
  report.file = command.file;
  report.summary = sinks.summary.summary();
  for (interpreter::ProgramIndex called = 1; !source.name_of(called).empty(); ++called) {
    report.called.push_back(program.file_of(source, called));
  }
  if (!command.lists_stops) return report;
  report.stops = CheckReport::ProgrammedStops{};
  report.stops->count = sinks.stops.count();
  for (const auto& [stop, times] : sinks.stops.places()) {
    report.stops->places.push_back({stop, times, block_text(source, stop.origin)});
  }
  return report;
}

int check(Context& context, const CheckCommand& command) {
  auto program = OfflineProgram::open(command);
  if (!program) return complain(program.error());
  SystemClock clock;
  const SteadyTime begun = clock.steady_now();
  CheckSinks sinks(program->setup().start, program->machine());
  auto source = program->source();
  const auto outcome = run(*program, command, source, sinks.of(command), clock);
  if (!outcome) return complain_offline(outcome.error());
  sinks.summary.rest();
  CheckReport report = report_of(*program, source, sinks, command);
  report.elapsed_seconds = std::chrono::duration<double>(clock.steady_now() - begun).count();
  if (outcome->has_stopped) report.stopped = sinks.state;
  if (context.wants_json) {
    context.print(json_text(check_json(report)));
  } else {
    context.print(check_text(report, context.has_color()));
  }
  if (!command.to.empty() && outcome->ended) return never_there(command);
  return outcome->ended || outcome->has_stopped ? kExitOk : kExitNo;
}

}  // namespace

void add_check_command(Command app, Context& context) {
  auto command =
      app.add_subcommand("check", "Check a program: warnings, alarm, lengths, time, extents");
  auto options = std::make_shared<CheckCommand>();
  add_offline_options(command, *options);
  command
      .add_option("--to", options->to,
                  "Stop after the first block with this number (120, N120) or on "
                  "this line (L7), and show the state of the machine there")
      .type_name("BLOCK");
  command.add_flag("--stops", options->lists_stops,
                   "List the blocks at which the program waits for the operator");
  add_json_flag(command, context);
  command.footer(
      "No server is needed. Times have acceleration where the setup's [machine] states it. A tape "
      "of several programs\n(tektronix-1704) is read on after each end that does not wind it back. "
      "Called programs come from the setup's library, or from FILE's "
      "folder;\nwarnings, alarms and stops in one name its file. The check continues over stops, "
      "and ends a program that\nrepeats without end with an alarm.\nA program that does not fit a "
      "tnc155's memory (3100 blocks, 999 in one program, 32 programs) gives a\nwarning, or with "
      "memory_limits = true in the setup's [control] an alarm.\n\nExit status: 0 the end was "
      "reached, or the block of --to; 1 an alarm, or that block was not reached;\n2 usage, "
      "unreadable file, unknown control.\n\nExamples:\n  dnc check --control centurion shaft.nc\n  "
      "dnc check --to 40 15.h\n  dnc check --stops 15.h");
  command.callback([&context, options] { context.status = check(context, *options); });
}

}  // namespace dripline::cli
