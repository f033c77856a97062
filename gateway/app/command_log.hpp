#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "gateway/report/outbox.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

/// How a command is answered.
struct Reply {
  bool is_accepted = true;
  std::string reason;
  std::string values = {};  ///< the same as JSON, where it has more than a text
};
inline Reply refuse(std::string reason) {
  return {false, std::move(reason)};
}

/// The answers to commands: kept in the outbox under the command's id, so that a command that
/// arrives again gets the same answer, and sent to the server. One thread.
class CommandLog {
 public:
  /// Both references must outlive it.
  CommandLog(std::string machine, report::Outbox& outbox, dds::GatewayEndpoint& endpoint)
      : machine_(std::move(machine)), outbox_(outbox), endpoint_(endpoint) {}

  /// The answer that was kept; none: the command is new. Errors: those of the outbox.
  Result<std::optional<Reply>> find(const std::string& command) const;
  /// The answer to any command that started the run.
  std::optional<Reply> find_start(const std::string& run) const;

  /// Stages an answer, for the next commit of the outbox.
  void stage(const std::string& command, const Reply& reply);
  /// Stages the acceptance of a start, under its run and, unless empty, its command. `notice`: what
  /// its operator has to know.
  void stage_start(const std::string& run, const std::string& command,
                   const std::string& notice = {});

  /// Queues an answer to be sent. A full queue drops the oldest: its sender asks again.
  void answer(const std::string& command, const Reply& reply);
  void send();
  bool is_sent() const { return waiting_.empty(); }

 private:
  std::string machine_;
  report::Outbox& outbox_;
  dds::GatewayEndpoint& endpoint_;
  std::deque<dds::CommandResult> waiting_;
};

/// Decides whether a command that moves something may still be carried out: by this gateway's
/// steady clock and the command's number alone, because the time of day of two machines differs.
/// Stops are always valid. One thread.
class CommandValidity {
 public:
  /// `session`: of this gateway.
  explicit CommandValidity(std::uint64_t session) : session_(session) {}

  /// Why it is refused; nothing when it is valid.
  std::optional<std::string> refusal(const dds::Command& command, SteadyTime now) const;
  /// A command that was given before this one and arrives after it moves nothing any more: a
  /// repeated resume must not undo a hold.
  void note_stop(const dds::Command& command);
  /// Something was done at the machine's panel: who gave a command before has not seen that.
  void note_panel(SteadyTime now);
  /// A hold or an abort has stopped axes that no run moves: who begins another motion meanwhile has
  /// not seen that.
  void note_stopped_motion(SteadyTime now);

  static constexpr std::chrono::milliseconds kUnseen{500};

 private:
  std::uint64_t session_;
  std::chrono::microseconds last_panel_{0}, last_stop_given_{0};
  std::optional<std::chrono::microseconds> stopped_motion_;
  std::uint64_t server_ = 0, last_stop_ = 0;
};

}  // namespace dripline::gateway
