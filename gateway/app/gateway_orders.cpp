#include <spdlog/spdlog.h>
#include <utility>

#include "gateway/app/gateway.hpp"
#include "gateway/feed/pull_feed.hpp"
#include "protocol/base/names.hpp"
#include "protocol/dds/stop_orders.hpp"

/// The part of the gateway that takes orders.
namespace dripline::gateway {

using dds::OrderAction;

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

void Gateway::on_order(const dds::Order& order) {
  if (order.action == OrderAction::Refuse) return on_refusal(order);
  const bool is_stop = stops(order);
  if (!is_stop && order.session != 0 && order.session != parts_.session) {
    spdlog::warn("order {} is for another gateway of this name {}", order.id, label());
    return;
  }
  const auto known = outbox_.order_result(order.id);
  if (!known) {
    spdlog::error("order {} cannot be looked up: {} {}", order.id, known.error().what, label());
    if (!is_stop) return;  // its sender tries again
  }
  if (known && *known) return answer(order, {(*known)->is_accepted, (*known)->reason});
  const Reply reply = carry_out(order, is_stop);
  spdlog::info("order {} {} {}{}{} {}", order.id, dds::to_string(order.action),
               reply.is_accepted ? "accepted" : "refused", reply.reason.empty() ? "" : ": ",
               reply.reason, label());
  const bool is_kept = order.action == OrderAction::Start && reply.is_accepted;
  if (!is_kept) keep_result(order, reply);
  answer(order, reply);
}

void Gateway::on_refusal(const dds::Order& order) {
  if (std::exchange(refused_by_server_, order.argument) == order.argument) return;
  spdlog::error("the server does not command this gateway: {} {}", order.argument, label());
}

/// What stops is done whenever it comes and whoever is meant: stopping once too often does no harm.
bool Gateway::stops(const dds::Order& order) const {
  return dds::is_stop(order.action, order.argument, order.value) ||
         dds::lowers_override(order.action, order.value, machine_.panel());
}

/// After a kill an order may be carried out twice; that does no harm, because the run it was meant
/// for has ended then. Records of half a block wait, and so does this.
void Gateway::keep_result(const dds::Order& order, const Reply& reply) {
  outbox_.add_order_result(order.id, reply.is_accepted, reply.reason);
  if (!recorder_.is_between_blocks()) return;
  const auto done = session_ ? recorder_.commit() : outbox_.commit();
  if (!done) spdlog::error("order {} not kept: {} {}", order.id, done.error().what, label());
}

void Gateway::answer(const dds::Order& order, const Reply& reply) {
  if (results_.size() >= kMaxResults) results_.pop_front();
  results_.push_back(
      {parts_.options.machine, order.id, reply.is_accepted, valid_text(reply.reason, kMaxReason)});
}

void Gateway::send_results() {
  while (!results_.empty() && parts_.endpoint.write(results_.front())) results_.pop_front();
}

Gateway::Reply Gateway::carry_out(const dds::Order& order, bool is_stop) {
  if (is_stop) {
    validity_.note_stop(order);
  } else if (auto refusal = validity_.refusal(order, parts_.clock.steady_now())) {
    return refuse(*std::move(refusal));
  }
  if (order.action == OrderAction::Start) return start(order);
  if (auto refusal = refusal_without_consent(order)) return *refusal;
  if (order.action == OrderAction::Switch) return set_switch(order);
  if (dds::is_override(order.action)) return set_override(order);
  if (!session_ || is_ending_) return refuse("no run is active");
  if (!order.run.empty() && order.run != session_->run().run)
    return refuse(fmt::format("run {} is not active, {} is", order.run, session_->run().run));
  return operate(order);
}

std::optional<Gateway::Reply> Gateway::refusal_of_start(const dds::Order& order) {
  const auto known = outbox_.order_result(start_key(order.run));
  if (known && *known) return Reply{(*known)->is_accepted, (*known)->reason};
  if (parts_.line != nullptr)
    return refuse(
        fmt::format("this machine takes its programs from line {}", parts_.line->address()));
  if (order.run.empty() || order.run.size() > report::RunJournal::kMaxRun)
    return refuse("a start needs a run of 1 to 40 bytes");
  if (session_)
    return refuse(fmt::format("busy with run {} of program {}", session_->run().run,
                              session_->run().program));
  if (order.control != parts_.options.control)
    return refuse(fmt::format("this machine's control is {}, the program is for '{}'",
                              parts_.options.control, order.control));
  if (const auto name = check_program_name(order.program); !name) return refuse(name.error().what);
  if (const auto digest = parse_digest(order.revision); !digest)
    return refuse(fmt::format("revision: {}", digest.error().what));
  if (order.size == 0 || order.size > kMaxProgramBytes)
    return refuse(
        fmt::format("a program of {} bytes, expected 1 to {}", order.size, kMaxProgramBytes));
  return std::nullopt;
}

Gateway::Reply Gateway::start(const dds::Order& order) {
  if (auto refusal = refusal_of_start(order)) return *refusal;
  auto from = parse_start_argument(order.argument);
  if (!from) return refuse(from.error().what);
  auto feed = std::make_unique<feed::PullFeed>(
      feed::FeedRun{parts_.options.machine, parts_.session, order.run, order.size},
      feed::PullFeedOptions{}, [this](const dds::BlockRequest& request) {
        return parts_.endpoint.write(request).has_value();
      });
  const auto done = begin_run({order.run, order.program, order.revision, order.control, order.size},
                              std::move(feed), {order.id, order.setup, *std::move(from)});
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
  outbox_.add_order_result(start_key(run.run), true, "");
  if (!started_by.order.empty()) outbox_.add_order_result(started_by.order, true, "");
  if (const auto done = outbox_.commit(); !done) {
    outbox_.discard();
    return fail(done.error().code, "the start can not be kept: {}", done.error().what);
  }
  parts_.journal.begin(run.run);
  take_panel_tables(setup);
  machine_.begin(setup.stands.value_or(setup.start));
  session_ = std::move(*session);
  session_->size_feed(parts_.options.speed.factor);
  last_step_ = parts_.clock.steady_now();
  last_message_.clear();
  was_emergency_stopped_ = false;
  consent_.await(last_step_ + parts_.options.cycle_start_wait);
  return {};
}

Gateway::Reply Gateway::operate(const dds::Order& order) {
  switch (order.action) {
    case OrderAction::Hold:
      machine_.hold();
      is_held_by_trouble_ = false;
      return {};
    case OrderAction::Resume:
      if (machine_.panel().emergency_stop) return refuse(std::string(kEmergencyStop));
      if (!recorder_.trouble().empty())
        return refuse(fmt::format("reports can not be kept: {}", recorder_.trouble()));
      if (consent_.is_awaited()) return cycle_start();
      if (machine_.resume()) {
        recorder_.clear_notice();
        return {};
      }
      if (session_->waits() == RunSession::Waits::ForOperator)
        return refuse(fmt::format("the program waits for an answer to: {}", session_->prompt()));
      return refuse("the machine is neither held nor stopped");
    case OrderAction::Abort:
      machine_.abort();
      return {};
    case OrderAction::Answer: {
      const auto taken = session_->answer(order.argument);
      return taken ? Reply{} : refuse(taken.error().what);
    }
    case OrderAction::Handwheel:
      return turn_handwheel(order);
    default:
      return refuse("not an order this gateway knows");
  }
}

}  // namespace dripline::gateway
