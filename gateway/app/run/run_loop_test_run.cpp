#include "gateway/app/run/run_loop.hpp"
#include "protocol/process/log.hpp"

/// A test run: the program is looked through with the control's memory and the machine's limits,
/// and nothing of it reaches the machine, its position, the control's memory or the modes of an
/// MDI.
namespace dripline::gateway {

void RunLoop::begin_test(std::unique_ptr<RunSession> session) {
  parts_.recorder.note({}, std::string(kTestRun));
  parts_.run.session = std::move(session);
  parts_.run.session->size_feed(std::nullopt);
  parts_.run.last_message.clear();
  parts_.run.was_emergency_stopped = false;
  last_step_ = next_sync_ = parts_.clock.steady_now();
}

void RunLoop::end_test(const ProgramCheck& check) {
  if (check.state() == ProgramCheck::State::Refused) {
    const interpreter::Diagnostic& found = check.refusal().diagnostic;
    return end(dds::RunOutcome::Alarmed, fmt::format("{} {}", found.id, found.text));
  }
  if (!check.unanswered().empty()) {
    return end(
        dds::RunOutcome::Aborted,
        fmt::format("test run: good as far as {}, where the program {}: the answer is not known "
                    "before it runs",
                    check.place(), check.unanswered()));
  }
  std::string time;
  if (const auto motion = check.motion_time())
    time = fmt::format(", {:.1f} s of motion at 100 %", motion->count());
  end(dds::RunOutcome::Tested, fmt::format("test run: {} blocks{}", check.block(), time));
}

void RunLoop::abort() {
  if (is_testing()) return end(dds::RunOutcome::Aborted, "test run: aborted by command");
  if (why_interrupted_.empty()) is_aborted_by_command_ = true;
  parts_.machine.abort();
}

}  // namespace dripline::gateway
