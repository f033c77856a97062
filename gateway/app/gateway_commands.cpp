#include <spdlog/spdlog.h>
#include <utility>

#include "gateway/app/gateway.hpp"
#include "gateway/feed/pull_feed.hpp"
#include "protocol/base/names.hpp"
#include "protocol/dds/stop_commands.hpp"

/// The part of the gateway that takes orders.
namespace dripline::gateway {

using dds::CommandAction;

namespace {

constexpr std::size_t kMaxResults = 256;  ///< waiting to be sent; the sender of an order asks again
constexpr std::uint64_t kMaxProgramBytes = 1ULL << 40;

constexpr std::string_view kEmergencyStop =
    "the emergency stop is pressed: release it first (switch emergency_stop off)";

/// The answer to a start is kept under its run as well: another order to start the same run gets
/// the same answer.
std::string start_key(const std::string& run) {
  return "run " + run;
}

}  // namespace

void Gateway::on_command(const dds::Command& command) {
  if (command.action == CommandAction::Refuse) return on_refusal(command);
  const bool is_stop = stops(command);
  if (!is_stop && command.session != 0 && command.session != parts_.session) {
    spdlog::warn("order {} is for another gateway of this name {}", command.id, label());
    return;
  }
  const auto known = outbox_.command_result(command.id);
  if (!known) {
    spdlog::error("order {} cannot be looked up: {} {}", command.id, known.error().what, label());
    if (!is_stop) return;  // its sender tries again
  }
  if (known && *known) return answer(command, {(*known)->is_accepted, (*known)->reason});
  const Reply reply = carry_out(command, is_stop);
  spdlog::info("order {} {} {}{}{} {}", command.id, dds::to_string(command.action),
               reply.is_accepted ? "accepted" : "refused", reply.reason.empty() ? "" : ": ",
               reply.reason, label());
  const bool is_kept = command.action == CommandAction::Start && reply.is_accepted;
  if (!is_kept) keep_result(command, reply);
  answer(command, reply);
}

void Gateway::on_refusal(const dds::Command& command) {
  if (std::exchange(refused_by_server_, command.argument) == command.argument) return;
  spdlog::error("the server does not command this gateway: {} {}", command.argument, label());
}

/// What stops is done whenever it comes and whoever is meant: stopping once too often does no harm.
bool Gateway::stops(const dds::Command& command) const {
  return dds::is_stop(command.action, command.argument, command.value) ||
         dds::lowers_override(command.action, command.value, machine_.panel());
}

/// After a kill an order may be carried out twice; that does no harm, because the run it was meant
/// for has ended then. Records of half a block wait, and so does this.
void Gateway::keep_result(const dds::Command& command, const Reply& reply) {
  outbox_.add_command_result(command.id, reply.is_accepted, reply.reason);
  if (!recorder_.is_between_blocks()) return;
  const auto done = session_ ? recorder_.commit() : outbox_.commit();
  if (!done) spdlog::error("order {} not kept: {} {}", command.id, done.error().what, label());
}

void Gateway::answer(const dds::Command& command, const Reply& reply) {
  if (results_.size() >= kMaxResults) results_.pop_front();
  results_.push_back({parts_.options.machine, command.id, reply.is_accepted,
                      valid_text(reply.reason, kMaxReason)});
}

void Gateway::send_results() {
  while (!results_.empty() && parts_.endpoint.write(results_.front())) results_.pop_front();
}

Gateway::Reply Gateway::carry_out(const dds::Command& command, bool is_stop) {
  if (is_stop) {
    validity_.note_stop(command);
  } else if (auto refusal = validity_.refusal(command, parts_.clock.steady_now())) {
    return refuse(*std::move(refusal));
  }
  if (command.action == CommandAction::Start) return start(command);
  if (auto refusal = refusal_without_consent(command)) return *refusal;
  if (command.action == CommandAction::Switch) return set_switch(command);
  if (dds::is_override(command.action)) return set_override(command);
  if (!session_ || is_ending_) return refuse("no run is active");
  if (!command.run.empty() && command.run != session_->run().run)
    return refuse(fmt::format("run {} is not active, {} is", command.run, session_->run().run));
  return operate(command);
}

std::optional<Gateway::Reply> Gateway::refusal_of_start(const dds::Command& command) {
  const auto known = outbox_.command_result(start_key(command.run));
  if (known && *known) return Reply{(*known)->is_accepted, (*known)->reason};
  if (parts_.line != nullptr)
    return refuse(
        fmt::format("this machine takes its programs from line {}", parts_.line->address()));
  if (command.run.empty() || command.run.size() > report::RunJournal::kMaxRun)
    return refuse("a start needs a run of 1 to 40 bytes");
  if (session_)
    return refuse(fmt::format("busy with run {} of program {}", session_->run().run,
                              session_->run().program));
  if (command.control != parts_.options.control)
    return refuse(fmt::format("this machine's control is {}, the program is for '{}'",
                              parts_.options.control, command.control));
  if (const auto name = check_program_name(command.program); !name)
    return refuse(name.error().what);
  if (const auto digest = parse_digest(command.revision); !digest)
    return refuse(fmt::format("revision: {}", digest.error().what));
  if (command.size == 0 || command.size > kMaxProgramBytes)
    return refuse(
        fmt::format("a program of {} bytes, expected 1 to {}", command.size, kMaxProgramBytes));
  return std::nullopt;
}

Gateway::Reply Gateway::start(const dds::Command& command) {
  if (auto refusal = refusal_of_start(command)) return *refusal;
  auto from = parse_start_argument(command.argument);
  if (!from) return refuse(from.error().what);
  auto feed = std::make_unique<feed::PullFeed>(
      feed::FeedRun{parts_.options.machine, parts_.session, command.run, command.size},
      feed::PullFeedOptions{}, [this](const dds::BlockRequest& request) {
        return parts_.endpoint.write(request).has_value();
      });
  const auto done =
      begin_run({command.run, command.program, command.revision, command.control, command.size},
                std::move(feed), {command.id, command.setup, *std::move(from)});
  return done ? Reply{} : refuse(done.error().what);
}

/// Our own setup with what the server knows of tools, offsets and variables in their place.
Result<interpreter::Setup> Gateway::setup_with(const std::string& control_data) const {
  interpreter::Setup setup = parts_.setup;
  if (control_data.empty()) return setup;
  auto data = interpreter::parse_control_data(control_data, parts_.dialect.units);
  if (!data) return fail(data.error());
  interpreter::use_control_data(*std::move(data), setup);
  return setup;
}

Result<void> Gateway::begin_run(const report::ActiveRun& run,
                                std::unique_ptr<feed::ProgramFeed> feed,
                                const StartedBy& started_by) {
  if (machine_.panel().emergency_stop) return fail(Errc::Busy, "{}", kEmergencyStop);
  auto known = setup_with(started_by.setup);
  if (!known) return fail(known.error().code, "the server's setup: {}", known.error().what);
  interpreter::Setup setup = *std::move(known);
  setup.switches.block_skip = machine_.panel().block_skip;
  const StartArgument& from = started_by.from;
  const bool is_taken_up = !from.place.empty();
  if (is_taken_up) {
    setup.control.set("start_at", {from.place, 0});
    if (from.pass) setup.control.set("start_pass", {std::int64_t{*from.pass}, 0});
    if (from.memory != StartMemory::Ask) {
      const bool is_former = from.memory == StartMemory::Begin;
      setup.control.set("start_memory", {std::string(is_former ? "begin" : "now"), 0});
    }
    setup.stands = machine_.status().position;
  }
  const interpreter::Position at = setup.stands.value_or(setup.start);
  if (auto done = machine_.check_begin(at); !done) return done;
  auto session = RunSession::make({.run = run,
                                   .feed = std::move(feed),
                                   .machine = machine_,
                                   .recorder = recorder_,
                                   .clock = parts_.clock,
                                   .memory = memory_,
                                   .begins_with_former_memory = from.memory == StartMemory::Begin},
                                  parts_.dialect, setup);
  if (!session) {
    const bool is_memory =
        session.error().code == Errc::Corrupt || session.error().code == Errc::NotFound;
    return fail(session.error().code, "{}{}", is_memory ? "" : "setup: ", session.error().what);
  }

  outbox_.discard();
  memory_.stage();
  if (!is_taken_up) memory_.stage_beginning(run.revision);
  recorder_.begin(run, [raw = session->get()] {
    return ExecutionRecorder::Supply{raw->feed().sent(), raw->accepted()};
  });
  outbox_.add_command_result(start_key(run.run), true, "");
  if (!started_by.command.empty()) outbox_.add_command_result(started_by.command, true, "");
  if (const auto done = outbox_.commit(); !done) {
    outbox_.discard();
    return fail(done.error().code, "the start cannot be kept: {}", done.error().what);
  }
  parts_.journal.begin(run.run);
  take_panel_tables(setup);
  machine_.begin(at);
  session_ = std::move(*session);
  session_->size_feed(parts_.options.speed.factor);
  last_step_ = parts_.clock.steady_now();
  last_message_.clear();
  was_emergency_stopped_ = false;
  consent_.await(last_step_ + parts_.options.cycle_start_wait);
  return {};
}

Gateway::Reply Gateway::operate(const dds::Command& command) {
  switch (command.action) {
    case CommandAction::Hold:
      machine_.hold();
      is_held_by_fault_ = false;
      return {};
    case CommandAction::Resume:
      if (machine_.panel().emergency_stop) return refuse(std::string(kEmergencyStop));
      if (!recorder_.trouble().empty())
        return refuse(fmt::format("reports cannot be kept: {}", recorder_.trouble()));
      if (consent_.is_awaited()) return cycle_start();
      if (machine_.resume()) {
        recorder_.clear_notice();
        return {};
      }
      if (session_->waits() == RunSession::Waits::ForOperator)
        return refuse(fmt::format("the program waits for an answer to: {}", session_->prompt()));
      return refuse("the machine is neither held nor stopped");
    case CommandAction::Abort:
      machine_.abort();
      return {};
    case CommandAction::Answer: {
      const auto taken = session_->answer(command.argument);
      return taken ? Reply{} : refuse(taken.error().what);
    }
    case CommandAction::Handwheel:
      return turn_handwheel(command);
    default:
      return refuse("not an order this gateway knows");
  }
}

}  // namespace dripline::gateway
