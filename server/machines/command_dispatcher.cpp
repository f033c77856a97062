#include "server/machines/command_dispatcher.hpp"

#include <algorithm>
#include <thread>

#include "gateway/interpreter/core/jog_move.hpp"
#include "protocol/base/random.hpp"
#include "protocol/dds/endpoint.hpp"
#include "server/machines/identifiers.hpp"

namespace dripline::machines {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMaxGivenUp = 64;
constexpr auto kRetry = 10ms;  ///< before a command is offered again to a full queue
/// The machine shows the run: so long the answer to its start is awaited, which has the reason.
constexpr auto kForReason = 1s;
/// A server that ends waits so long for answers to what it has sent.
constexpr auto kLastAnswer = 1s;

/// These are sent at once, whatever is known of the gateway. Only the gateway knows whether an
/// override is lowered.
bool may_stop(const dds::Command& command) {
  return dds::is_stop(command.action, command.argument, command.value) ||
         dds::is_override(command.action) || command.action == dds::CommandAction::Refuse;
}

bool is_jog(const dds::Command& command) {
  return command.action == dds::CommandAction::Jog;
}

bool keeps_jog(const dds::Command& command) {
  return is_jog(command) && interpreter::parse_jog_keep(command.argument);
}

bool is_question(const dds::Command& command) {
  return command.action == dds::CommandAction::Query ||
         command.action == dds::CommandAction::Playback;
}

/// One that may have begun to move, or was given to a machine whose switches were seen: the next
/// gateway begins with others.
bool is_for_one_gateway(const dds::Command& command) {
  return !may_stop(command) && !is_question(command);
}

std::string text_of_replaced(const dds::Command& command) {
  std::string_view outcome = "whether it was carried out is not known";
  if (is_jog(command)) outcome = "whether the axis has moved is not known";
  if (command.action == dds::CommandAction::Start)
    outcome = "nothing has begun at the new one, whose switches (test run, machine lock) are off";
  return fmt::format("machine {}: its gateway was replaced before it answered {}; {}",
                     command.machine, dds::to_string(command.action), outcome);
}

}  // namespace

CommandDispatcher::CommandDispatcher(dds::ServerEndpoint& endpoint, const Clock& clock,
                                     Options options,
                                     std::function<void(const dds::Command&)> on_late_start)
    : session_(random_number() | 1),
      endpoint_(endpoint),
      clock_(clock),
      options_(std::move(options)),
      on_late_start_(std::move(on_late_start)) {}

std::chrono::milliseconds CommandDispatcher::life_of(const dds::Command& command) const {
  if (keeps_jog(command)) return options_.keep_expiry;
  return is_jog(command) ? options_.jog_expiry : options_.expiry;
}

/// The gateway that it was given to is not the present one.
bool CommandDispatcher::is_replaced(const dds::Command& command) const {
  return options_.gateway_of && is_for_one_gateway(command) &&
         options_.gateway_of(command.machine).session != command.session;
}

CommandDispatcher::Times CommandDispatcher::stamp(dds::Command& command, const Origin& origin) {
  const auto life = life_of(command);
  command.id = make_command_id();
  command.expires = may_stop(command) ? UtcTime::max() : clock_.now() + life;
  if (command.session == 0 && is_for_one_gateway(command) && options_.gateway_of)
    command.session = options_.gateway_of(command.machine).session;
  command.server = session_;
  const SteadyTime now = clock_.steady_now();
  return {.given = origin.given.value_or(now), .deadline = now + life};
}

/// Its number: the gateway carries out nothing with one below that of the last stop.
Result<void> CommandDispatcher::take_turn(dds::Command& command, const Origin& origin) {
  const SteadyTime now = clock_.steady_now();
  const SteadyTime given = origin.given.value_or(now);
  const bool is_start = command.action == dds::CommandAction::Start;  // has its own limit
  if (!origin.is_stop && !is_start) {
    const auto limit = is_jog(command) ? life_of(command) : StopOrder::kMaxWait;
    if (auto soon = check_age(command.machine, command.action, given, now, limit); !soon)
      return soon;
  }
  const std::lock_guard lock(mutex_);
  if (origin.is_stop && dds::is_override(command.action)) {
    auto lower = stops_.check_lowered(command.machine, command.action, given, command.value);
    if (!lower) return lower;
    stops_.note(command.machine, command.action, given, command.value);
  } else if (origin.is_stop) {
    stops_.note(command.machine, command.action, given);
  } else if (auto first = stops_.check(command.machine, command.action, given); !first) {
    return first;
  }
  command.number = ++last_number_;
  return {};
}

void CommandDispatcher::note_stop(const std::string& machine, dds::CommandAction action,
                                  std::optional<SteadyTime> given) {
  const std::lock_guard lock(mutex_);
  stops_.note(machine, action, given.value_or(clock_.steady_now()));
}

Result<void> CommandDispatcher::send(dds::Command command) {
  const Times times = stamp(command, {});
  {
    const std::lock_guard lock(mutex_);
    command.number = ++last_number_;
  }
  return write_in_time(command, times);
}

/// To the present gateway of the machine, in terms of its clock.
Result<void> CommandDispatcher::send_to_present(dds::Command command, const Times& times) {
  if (options_.gateway_of) {
    const auto gateway = options_.gateway_of(command.machine);
    if (is_for_one_gateway(command) && command.session != gateway.session)
      return fail(Errc::Conflict, "{}", text_of_replaced(command));
    command.session = gateway.session;
    if (gateway.steady_ahead) {
      const auto by_its_clock = [&](SteadyTime time) {
        return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()) +
               *gateway.steady_ahead;
      };
      command.given = by_its_clock(times.given);
      command.deadline = by_its_clock(times.deadline);
    } else if (!may_stop(command)) {
      return fail(Errc::Timeout, "machine {} has not reported its status yet", command.machine);
    }
  }
  return endpoint_.write(command);
}

Result<void> CommandDispatcher::carry_out(dds::Command command, const Origin& origin) {
  const auto result = send_and_await(std::move(command), origin);
  if (!result) return fail(result.error());
  return {};
}

Result<std::string> CommandDispatcher::ask(dds::Command query) {
  auto result = send_and_await(std::move(query), {});
  if (!result) return fail(result.error());
  return std::move(result->values);
}

Result<dds::CommandResult> CommandDispatcher::send_and_await(dds::Command command,
                                                             const Origin& origin) {
  const Times times = stamp(command, origin);
  if (auto turn = take_turn(command, origin); !turn) return fail(turn.error());
  const std::string id = command.id;
  {
    const std::lock_guard lock(mutex_);
    waiting_[id] = {.command = command, .result = {}, .times = times};
  }
  const auto written = write_in_time(command, times);
  auto outcome = written ? await(id) : Result<dds::CommandResult>(fail(written.error()));
  const std::lock_guard lock(mutex_);
  const bool is_unknown = !outcome && outcome.error().code == Errc::Timeout;
  if (is_unknown && command.action == dds::CommandAction::Start) {
    given_up_.push_back(std::move(command));
    if (given_up_.size() > kMaxGivenUp) given_up_.pop_front();
  }
  waiting_.erase(id);
  return outcome;
}

Result<void> CommandDispatcher::write_in_time(const dds::Command& command, const Times& times) {
  const auto limit = std::chrono::steady_clock::now() + life_of(command);
  for (;;) {
    auto written = send_to_present(command, times);
    if (written || written.error().code != Errc::Timeout) return written;
    if (std::chrono::steady_clock::now() >= limit) return written;
    std::this_thread::sleep_for(kRetry);
  }
}

Result<dds::CommandResult> CommandDispatcher::await(const std::string& id) {
  std::unique_lock lock(mutex_);
  const Waiting& waiting = waiting_.at(id);
  const bool is_awaited_to_its_end = is_jog(waiting.command) && !keeps_jog(waiting.command);
  const auto wait = is_awaited_to_its_end ? options_.jog_end : life_of(waiting.command);
  const auto expiry = std::chrono::steady_clock::now() + wait;
  const auto limit = expiry + options_.grace;
  const auto is_resolved = [&] { return waiting.result.has_value() || is_stopping_; };
  for (auto next = std::chrono::steady_clock::now() + options_.repeat; next < expiry;
       next += options_.repeat) {
    if (changed_.wait_until(lock, next, is_resolved)) break;
    dds::Command again = waiting.command;
    lock.unlock();
    // A full queue or a disconnected machine: the next round tries again, until the limit.
    const auto written = send_to_present(std::move(again), waiting.times);
    lock.lock();
    if (waiting.is_seen) break;
    if (!written && written.error().code == Errc::Conflict && !waiting.result)
      return fail(Errc::Timeout, "{}", written.error().what);
  }
  const auto soon = std::chrono::steady_clock::now() + kForReason;
  const bool is_decided =
      changed_.wait_until(lock, waiting.is_seen ? std::min(soon, limit) : limit, is_resolved);
  // The answer is usually coming: what its caller gets then is what has happened.
  if (is_decided && !waiting.result && !waiting.is_seen)
    changed_.wait_for(lock, kLastAnswer, [&] { return waiting.result.has_value(); });
  if (waiting.result) {
    if (waiting.result->accepted) return *waiting.result;
    return fail(Errc::Busy, "machine {} refused {}: {}", waiting.command.machine,
                dds::to_string(waiting.command.action), waiting.result->reason);
  }
  if (waiting.is_seen) {
    return dds::CommandResult{
        .machine = waiting.command.machine, .id = id, .accepted = true, .reason = {}};
  }
  if (is_decided)
    return fail(Errc::Timeout,
                "the server is stopping: whether machine {} has carried out {} is not known",
                waiting.command.machine, dds::to_string(waiting.command.action));
  if (is_replaced(waiting.command))
    return fail(Errc::Timeout, "{}", text_of_replaced(waiting.command));
  return fail(Errc::Timeout, "machine {} did not answer {} within {} s", waiting.command.machine,
              dds::to_string(waiting.command.action), std::chrono::duration<double>(wait).count());
}

void CommandDispatcher::on_result(const dds::CommandResult& result) {
  std::optional<dds::Command> late;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = waiting_.find(result.id); found != waiting_.end()) {
      if (found->second.command.machine == result.machine) found->second.result = result;
    } else if (result.accepted) {
      const auto given_up = std::ranges::find(given_up_, result.id, &dds::Command::id);
      if (given_up != given_up_.end()) {
        late = std::move(*given_up);
        given_up_.erase(given_up);
      }
    }
  }
  changed_.notify_all();
  if (late) on_late_start_(*late);
}

void CommandDispatcher::on_run_seen(const std::string& machine, const std::string& run) {
  const std::lock_guard lock(mutex_);
  for (auto& [id, waiting] : waiting_) {
    const bool is_start = waiting.command.action == dds::CommandAction::Start &&
                          waiting.command.run == run && waiting.command.machine == machine;
    if (is_start) waiting.is_seen = true;
  }
}

bool CommandDispatcher::is_waiting_for(const std::string& run) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(waiting_, [&](const auto& entry) {
    const dds::Command& command = entry.second.command;
    return command.action == dds::CommandAction::Start && command.run == run;
  });
}

bool CommandDispatcher::is_stopping() const {
  const std::lock_guard lock(mutex_);
  return is_stopping_;
}

void CommandDispatcher::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
}

}  // namespace dripline::machines
