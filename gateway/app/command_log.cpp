#include "gateway/app/command_log.hpp"

#include "gateway/app/run_texts.hpp"

namespace dripline::gateway {
namespace {

constexpr std::size_t kMaxWaiting = 256;

std::string start_key(const std::string& run) {
  return "run " + run;
}

}  // namespace

Result<std::optional<Reply>> CommandLog::find(const std::string& command) const {
  auto known = outbox_.command_result(command);
  if (!known) return fail(known.error());
  if (!*known) return std::optional<Reply>();
  return std::optional(Reply{(*known)->is_accepted, (*known)->reason});
}

std::optional<Reply> CommandLog::find_start(const std::string& run) const {
  auto known = find(start_key(run));
  return known ? *std::move(known) : std::nullopt;
}

void CommandLog::stage(const std::string& command, const Reply& reply) {
  outbox_.add_command_result(command, reply.is_accepted, reply.reason);
}

void CommandLog::stage_start(const std::string& run, const std::string& command) {
  stage(start_key(run), {});
  if (!command.empty()) stage(command, {});
}

void CommandLog::answer(const std::string& command, const Reply& reply) {
  if (waiting_.size() >= kMaxWaiting) waiting_.pop_front();
  waiting_.push_back({machine_, command, reply.is_accepted, valid_text(reply.reason, kMaxReason)});
}

void CommandLog::send() {
  while (!waiting_.empty() && endpoint_.write(waiting_.front())) waiting_.pop_front();
}

}  // namespace dripline::gateway
