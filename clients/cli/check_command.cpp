#include <memory>

#include "clients/cli/check_report.hpp"
#include "clients/cli/commands.hpp"
#include "clients/cli/json_text.hpp"
#include "clients/cli/offline_options.hpp"
#include "clients/cli/progress.hpp"
#include "gateway/interpreter/trace/event_tee.hpp"
#include "gateway/interpreter/trace/offline_run.hpp"

namespace dripline::cli {
namespace {

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

/// Runs the program into `summary`, with a progress bar on a terminal.
Result<interpreter::OfflineOutcome> run(const OfflineProgram& program, const std::string& label,
                                        interpreter::CheckSummary& summary, const Clock& clock) {
  auto source = program.source();
  LiveArea area = LiveArea::on_stderr();
  if (!area.is_live()) {
    return interpreter::run_offline(program.dialect(), program.setup(), source, summary);
  }
  Progress bar(area, clock, label);
  CheckProgress progress(bar, program.text().size());
  interpreter::EventTee both(summary, progress);
  return interpreter::run_offline(program.dialect(), program.setup(), source, both);
}

int check(Context& context, const OfflineCommand& command) {
  auto program = OfflineProgram::open(command);
  if (!program) return complain(program.error());
  SystemClock clock;
  const SteadyTime begun = clock.steady_now();
  interpreter::CheckSummary summary(program->setup().start);
  const auto outcome = run(*program, command.file, summary, clock);
  if (!outcome) return complain_offline(outcome.error());
  const double elapsed = std::chrono::duration<double>(clock.steady_now() - begun).count();
  const CheckReport report{command.file, summary.summary(), elapsed};
  if (context.wants_json) {
    context.print(json_text(check_json(report)));
  } else {
    context.print(check_text(report, context.has_colour()));
  }
  return outcome->ended ? kExitOk : kExitNo;
}

}  // namespace

void add_check_command(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "check", "Interpret a program on disk: warnings, alarm, lengths, time, extents");
  auto options = std::make_shared<OfflineCommand>();
  add_offline_options(*command, *options);
  add_json_flag(*command, context);
  command->footer(
      "No server is needed. Called programs come from the setup's library, or from FILE's "
      "folder.\n\nExit status: 0 the end was reached, 1 an alarm, 2 usage, unreadable file, "
      "unknown "
      "control.\n\nExample:\n  dnc check --control centurion shaft.nc");
  command->callback([&context, options] { context.status = check(context, *options); });
}

}  // namespace dripline::cli
