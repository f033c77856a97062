#include "gateway/app/gateway.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/process/log.hpp"

/// The gateway's commands that move one axis without a program.
namespace dripline::gateway {

/// Neither logged nor kept: there are ten of them a second, and each is good for a moment alone.
void Gateway::keep_jog(const dds::Command& command, const std::string& hold) {
  const auto refusal = refusal_of_jog(command);
  commands_.answer(command.id, refusal ? *refusal : jogger_.keep(hold));
}

void Gateway::on_jog(const dds::Command& command) {
  if (const auto hold = interpreter::parse_jog_keep(command.argument))
    return keep_jog(command, *hold);
  const auto refusal = begin_jog(command);
  process::log_info("command {} jog {} {}{} {}", command.id, command.argument,
                    refusal ? "refused: " : "begun", refusal ? refusal->reason : "", run_.label());
  if (refusal) give_answer(command.id, *refusal);
  server_.want_status();
}

/// Not one for another gateway, nor a late one, whose sender does not expect the move any more.
std::optional<Reply> Gateway::refusal_of_jog(const dds::Command& command) const {
  if (stop_requested_) return refuse(std::string(kIsStopping));
  if (auto refusal = validity_.refusal(command, parts_.clock.steady_now()))
    return refuse(*std::move(refusal));
  if (auto refusal = panel_.refusal_without_consent(command)) return refusal;
  return refusal_of_fault();
}

std::optional<Reply> Gateway::begin_jog(const dds::Command& command) {
  if (auto refusal = refusal_of_jog(command)) return refusal;
  if (!jogger_.is_active()) loop_.begin_jog();
  return jogger_.begin(command);
}

/// False: nothing is jogged.
bool Gateway::stop_jog(std::string_view why) {
  if (!jogger_.is_active()) return false;
  jogger_.stop(why);
  return true;
}

void Gateway::answer_jog() {
  const auto answer = jogger_.take_answer();
  if (!answer) return;
  loop_.end_jog(answer->reply.is_accepted);
  process::log_info("jog {} ended: {} {}", answer->command, answer->reply.reason, run_.label());
  give_answer(answer->command, answer->reply);
  server_.want_status();
}

}  // namespace dripline::gateway
