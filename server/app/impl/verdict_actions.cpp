#include "server/app/impl/server_parts.hpp"

namespace dripline::app {
namespace {

/// Who holds a machine or its queue.
std::string template_of(const storage::MeasuredPart& part) {
  return fmt::format("report template {} version {}", part.template_name, part.template_version);
}

}  // namespace

Result<void> ServerParts::hold_queue(const storage::MeasuredPart& part, const std::string& reason) {
  return jobs.hold(part.machine, reason, template_of(part));
}

/// What moves is held first, whatever becomes of the queue. A report is often the last thing of a
/// program: where the run is over, what can be held is what would come next.
Result<void> ServerParts::hold_machine(const storage::MeasuredPart& part,
                                       const std::string& reason) {
  const auto held = hold_motion(part, reason);
  const auto queue = hold_queue(part, reason);
  return held ? queue : held;
}

Result<void> ServerParts::hold_motion(const storage::MeasuredPart& part,
                                      const std::string& reason) {
  const bool is_of_run = !part.run.empty();
  const auto has_ended = [&] {
    const auto run = store->runs.find(part.run);
    return is_of_run && run && storage::is_finished(run->state);
  };
  if (has_ended()) return {};
  library::AuditTrail::Change change{.who = template_of(part),
                                     .action = is_of_run ? "run.hold" : "machine.hold",
                                     .subject = is_of_run ? part.run : part.machine,
                                     .detail = reason};
  audit.write(change);
  machines::CommandRequest hold;
  hold.action = dds::CommandAction::Hold;
  (is_of_run ? hold.run : hold.machine) = is_of_run ? part.run : part.machine;
  hold.who = template_of(part);
  hold.reason = reason;
  auto done = machines.command(hold);
  if (done) return done;
  change.detail += ": refused, " + done.error().what;
  audit.write(std::move(change));
  return has_ended() ? Result<void>() : done;
}

}  // namespace dripline::app
