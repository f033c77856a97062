#include <algorithm>
#include <utility>

#include "gateway/app/gateway.hpp"
#include "gateway/app/memory/control_values.hpp"
#include "gateway/app/run/start_checks.hpp"
#include "gateway/feed/pull_feed.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/process/log.hpp"

/// The gateway's commands from the network.
namespace dripline::gateway {

using dds::CommandAction;

void Gateway::on(const dds::Command& command, SteadyTime) {
  if (command.action == CommandAction::Refuse) return server_.on_refusal(command);
  const bool is_stop = stops(command);
  if (!is_stop && command.session != 0 && command.session != parts_.session) {
    process::log_warning("command {} is for another gateway of this name {}", command.id,
                         run_.label());
    return;
  }
  if (command.action == CommandAction::Query) return answer_query(command);
  const auto known = commands_.find(command.id);
  if (!known) {
    process::log_error("command {} cannot be looked up: {} {}", command.id, known.error().what,
                       run_.label());
    if (!is_stop) return;  // its sender tries again
  }
  if (known && *known) return commands_.answer(command.id, **known);
  if (jogger_.is_of(command.id)) return;  // it is answered when the axis rests
  if (command.action == CommandAction::Jog) return on_jog(command);
  const Reply reply = carry_out(command, is_stop);
  process::log_info("command {} {} {}{}{} {}", command.id, dds::to_string(command.action),
                    reply.is_accepted ? "accepted" : "refused", reply.reason.empty() ? "" : ": ",
                    reply.reason, run_.label());
  const bool is_kept = reply.is_accepted && (command.action == CommandAction::Start ||
                                             command.action == CommandAction::SetPosition);
  if (!is_kept) keep_answer(command.id, reply);
  commands_.answer(command.id, reply);
}

/// MOD functions take effect at once. The position of axes at rest is shown as the next start finds
/// it, unless a program has left its own coordinates in force.
void Gateway::show_setup(const std::string& text) {
  if (setup_shown_ == text) return;
  const auto setup = positions_.setup_of(text);
  if (!setup) return;  // the next start is refused for it
  setup_shown_ = text;
  status_.take_settings(*setup);
  if (!run_.session && !run_.frame_left) run_.frame_at_rest = positions_.frame_at_start(text);
  server_.want_status();
}

/// It changes nothing but what the screen shows, so it is answered at once, as often as it comes,
/// and not kept: its sender asks again when an answer is lost.
void Gateway::answer_query(const dds::Command& command) {
  show_setup(command.setup);
  if (run_.session) run_.session->keep_memory(machine_->status().executed);
  const double first = std::clamp(command.value, 0.0, 1e9);
  dds::CommandResult result{
      .machine = parts_.options.machine, .id = command.id, .accepted = true, .reason = {}};
  std::optional<ControlMemory> at_start;  // before the first run what its start would find
  if (!memory_.has_begun()) {
    if (auto found = positions_.memory_at_start(command.setup)) at_start.emplace(*std::move(found));
  }
  result.values = control_values(
      {.beginning = command.argument, .passed_over = static_cast<std::size_t>(first)},
      at_start ? *at_start : memory_, recorder_, *machine_);
  [[maybe_unused]] const auto written = parts_.endpoint.write(result);
}

/// A stop is carried out whenever it arrives and for any session: one stop too many does no harm.
bool Gateway::stops(const dds::Command& command) const {
  return dds::is_stop(command.action, command.argument, command.value) ||
         dds::lowers_override(command.action, command.value, machine_->panel());
}

/// After a kill a command may be carried out twice; that does no harm, because the run it was meant
/// for has ended then. Records of half a block wait, and so does this.
void Gateway::keep_answer(const std::string& command, const Reply& reply) {
  commands_.stage(command, reply);
  if (!recorder_.is_between_blocks()) return;
  const auto done = run_.session ? recorder_.commit() : outbox_.commit();
  if (!done)
    process::log_error("command {} not kept: {} {}", command, done.error().what, run_.label());
}

void Gateway::give_answer(const std::string& command, const Reply& reply) {
  keep_answer(command, reply);
  commands_.answer(command, reply);
}

/// The run's end is on record already; the machine may still brake.
Reply Gateway::stop_at_end() {
  machine_->abort();
  return {true, std::string(kHasStopped)};
}

Reply Gateway::carry_out(const dds::Command& command, bool is_stop) {
  if (is_stop) {
    validity_.note_stop(command);
  } else if (auto refusal = validity_.refusal(command, parts_.clock.steady_now())) {
    return refuse(*std::move(refusal));
  }
  if (stop_requested_ && !is_stop) return refuse(std::string(kIsStopping));
  if (command.action == CommandAction::Start) return start(command);
  const bool is_abort = command.action == CommandAction::Abort;
  if (is_abort && command.argument == dds::kJogAbort)
    return stop_jog("by command") ? Reply{} : refuse("nothing is jogged");
  const bool ends_motion = is_abort || command.action == CommandAction::Hold;
  if (ends_motion && stop_without_run("by command")) return {};
  if (auto refusal = panel_.refusal_without_consent(command)) return *refusal;
  if (command.action == CommandAction::SetPosition) return set_position(command);
  if (command.action == CommandAction::Playback) {
    auto block = positions_.playback(command.argument, command.setup);
    return block ? Reply{true, *std::move(block)} : refuse(block.error().what);
  }
  if (command.action == CommandAction::Switch) return panel_.set_switch(command);
  if (dds::is_override(command.action)) return panel_.set_override(command);
  if (!run_.is_active() && stop_requested_ && ends_motion) return stop_at_end();
  if (!run_.is_active()) return refuse("no run is active");
  if (!command.run.empty() && command.run != run_.session->run().run)
    return refuse(fmt::format("run {} is not active, {} is", command.run, run_.session->run().run));
  return operate(command);
}

std::optional<Reply> Gateway::refusal_of_start(const dds::Command& command) const {
  if (auto known = commands_.find_start(command.run)) return known;
  if (line_)
    return refuse(fmt::format("this machine takes its programs from line {}", line_->address()));
  if (jogger_.is_active()) return refuse(std::string(kIsJogging));
  if (command.run.empty() || command.run.size() > report::RunJournal::kMaxRun)
    return refuse("a start needs a run of 1 to 40 bytes");
  if (run_.session)
    return refuse(fmt::format("busy with run {} of program {}", run_.session->run().run,
                              run_.session->run().program));
  return refusal_of_program(command, parts_.options);
}

Reply Gateway::start(const dds::Command& command) {
  if (auto refusal = refusal_of_start(command)) return *refusal;
  auto from = parse_start_argument(command.argument);
  if (!from) return refuse(from.error().what);
  if (from->head != line::HeadChoice::Ask)
    return refuse("head is for controls on a serial line: this gateway looks through the program");
  if (from->is_mdi && parts_.dialect.mdi_blocks == 0)
    return refuse(fmt::format("control {} has no MDI", parts_.dialect.name));
  auto feed = std::make_unique<feed::PullFeed>(
      feed::FeedRun{parts_.options.machine, parts_.session, command.run, command.size},
      feed::PullFeedOptions{}, [this](const dds::BlockRequest& request) {
        return parts_.endpoint.write(request).has_value();
      });
  const auto done =
      loop_.begin({command.run, command.program, command.revision, command.control, command.size},
                  std::move(feed), {command.id, command.setup, *std::move(from), command.argument});
  return done ? Reply{true, valid_text(loop_.notice(), kMaxReason)} : refuse(done.error().what);
}

Reply Gateway::operate(const dds::Command& command) {
  switch (command.action) {
    case CommandAction::Hold:
      if (loop_.is_testing()) return refuse(std::string(kNoHoldOfTest));
      machine_->hold();
      loop_.keep_hold();
      return {};
    case CommandAction::Resume:
      if (machine_->needs_operator()) return refuse(std::string(kDoorWasOpen));
      return resume();
    case CommandAction::Abort:
      loop_.abort();
      return {};
    case CommandAction::Answer: {
      const auto taken = run_.session->answer(command.argument);
      return taken ? Reply{} : refuse(taken.error().what);
    }
    case CommandAction::Handwheel:
      return panel_.turn_handwheel(command);
    default:
      return refuse("this gateway does not know the command");
  }
}

std::optional<Reply> Gateway::refusal_of_fault() const {
  if (recorder_.fault().empty()) return std::nullopt;
  return refuse(fmt::format("reports cannot be kept: {}", recorder_.fault()));
}

/// The memory, its record and the answer are on disk together, or nothing has changed.
Reply Gateway::set_position(const dds::Command& command) {
  if (line_) {
    return refuse(fmt::format("this machine is the control at the end of line {}: set it there",
                              line_->address()));
  }
  if (run_.session)
    return refuse(fmt::format("run {} is active: nothing is set while a program runs",
                              run_.session->run().run));
  if (jogger_.is_active()) return refuse(std::string(kIsJogging));
  if (machine_->panel().emergency_stop) return refuse(std::string(kEmergencyStop));
  if (auto refusal = refusal_of_fault()) return *refusal;
  if (const auto kept = outbox_.commit(); !kept)
    return refuse(fmt::format("what was done before cannot be kept yet: {}", kept.error().what));
  const auto before = memory_.save();
  const auto change = positions_.set(command.argument, command.program, command.setup);
  if (!change) {
    memory_.restore(*before);
    return refuse(change.error().what);
  }
  Reply reply{true, valid_text(change->text, kMaxReason), change->details};
  memory_.stage();
  recorder_.note_memory_change(std::string(dds::kChangePrefix) + command.id,
                               memory_.report(change->record));
  commands_.stage(command.id, reply);
  if (const auto done = outbox_.commit(); !done) {
    outbox_.discard();
    memory_.restore(*before);
    return refuse(fmt::format("what was set cannot be kept: {}", done.error().what));
  }
  (void)memory_.take_change();  // it is reported
  run_.frame_at_rest = positions_.frame_at_start(command.setup);
  server_.want_status();
  return reply;
}

Reply Gateway::resume() {
  if (machine_->panel().emergency_stop) return refuse(std::string(kEmergencyStop));
  if (auto refusal = refusal_of_fault()) return *refusal;
  if (consent_.is_awaited()) return cycle_start();
  if (machine_->resume()) {
    recorder_.clear_notice();
    return {};
  }
  if (run_.session->waits() == RunSession::Waits::ForOperator)
    return refuse(fmt::format("the program waits for an answer to: {}", run_.session->prompt()));
  return refuse("the machine is neither held nor stopped");
}

}  // namespace dripline::gateway
