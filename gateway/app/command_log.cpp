#include "gateway/app/command_log.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "gateway/app/run/run_texts.hpp"

namespace dripline::gateway {
namespace {

constexpr std::size_t kMaxWaiting = 256;

/// In what is kept, between the text of an answer and its values: no text has it.
constexpr char kValues = '\x1f';

std::string start_key(const std::string& run) {
  return "run " + run;
}

bool begins_motion(const dds::Command& command) {
  return command.action == dds::CommandAction::Start || command.action == dds::CommandAction::Jog;
}

}  // namespace

Result<std::optional<Reply>> CommandLog::find(const std::string& command) const {
  auto known = outbox_.command_result(command);
  if (!known) return fail(known.error());
  if (!*known) return std::optional<Reply>();
  const std::string& kept = (*known)->reason;
  const std::size_t end = std::min(kept.find(kValues), kept.size());
  return std::optional(Reply{(*known)->is_accepted, kept.substr(0, end),
                             end < kept.size() ? kept.substr(end + 1) : std::string()});
}

std::optional<Reply> CommandLog::find_start(const std::string& run) const {
  auto known = find(start_key(run));
  return known ? *std::move(known) : std::nullopt;
}

void CommandLog::stage(const std::string& command, const Reply& reply) {
  const std::string values = reply.values.empty() ? "" : kValues + reply.values;
  outbox_.add_command_result(command, reply.is_accepted, reply.reason + values);
}

void CommandLog::stage_start(const std::string& run, const std::string& command,
                             const std::string& notice) {
  const Reply accepted{true, valid_text(notice, kMaxReason)};
  stage(start_key(run), accepted);
  if (!command.empty()) stage(command, accepted);
}

void CommandLog::answer(const std::string& command, const Reply& reply) {
  if (waiting_.size() >= kMaxWaiting) waiting_.pop_front();
  waiting_.push_back(
      {machine_, command, reply.is_accepted, valid_text(reply.reason, kMaxReason), reply.values});
}

void CommandLog::send() {
  while (!waiting_.empty() && endpoint_.write(waiting_.front())) waiting_.pop_front();
}

std::optional<std::string> CommandValidity::refusal(const dds::Command& command,
                                                    SteadyTime now) const {
  using std::chrono::microseconds;
  if (command.deadline == microseconds{0} || command.server == 0 || command.session != session_) {
    return fmt::format(
        "the command names no session and deadline: the server is older than protocol {}",
        dds::kProtocolVersion);
  }
  const auto time = std::chrono::duration_cast<microseconds>(now.time_since_epoch());
  if (time > command.deadline) {
    return fmt::format("the command came {:.1f} s after its deadline",
                       std::chrono::duration<double>(time - command.deadline).count());
  }
  const bool is_given = command.given != microseconds{0};
  if ((command.server == server_ && command.number < last_stop_) ||
      (is_given && command.given < last_stop_given_))
    return "a later command has stopped the machine meanwhile";
  if (is_given && command.given < last_panel_) {
    return fmt::format("the machine's panel was used {:.1f} s after the command was given",
                       std::chrono::duration<double>(last_panel_ - command.given).count());
  }
  const bool is_unseen = stopped_motion_ && command.given < *stopped_motion_ + kUnseen;
  if (is_given && is_unseen && begins_motion(command))
    return "the axes were stopped as the command was given: look at the machine, then repeat it";
  return std::nullopt;
}

void CommandValidity::note_stopped_motion(SteadyTime now) {
  stopped_motion_ = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
}

void CommandValidity::note_panel(SteadyTime now) {
  last_panel_ = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch());
}

void CommandValidity::note_stop(const dds::Command& command) {
  if (command.server != server_) last_stop_ = 0;
  server_ = command.server;
  last_stop_ = std::max(last_stop_, command.number);
  if (!dds::is_override(command.action))
    last_stop_given_ = std::max(last_stop_given_, command.given);
}

}  // namespace dripline::gateway
