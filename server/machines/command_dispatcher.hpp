#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"
#include "server/machines/stop_order.hpp"

namespace dripline::machines {

/// Sends commands and waits for their results. Every command has an id, a number and a deadline by
/// the gateway's own steady clock, so that a delayed one moves nothing late. A command that stops
/// is carried out whenever it arrives (dripline.idl).
class CommandDispatcher {
 public:
  struct Options {
    std::chrono::milliseconds expiry{5000};
    std::chrono::milliseconds grace{1000};  ///< for a result given just before the expiry
    /// Of a jog, which moves an axis: it is begun at once or never, and answered at its end. The
    /// longest that a gateway takes has to end within the second.
    std::chrono::milliseconds jog_expiry{2000}, jog_end{17'000};
    /// Of what keeps a held jog moving: a late one must not.
    std::chrono::milliseconds keep_expiry{250};
    /// A command without an answer is sent again, with the same id: the first may have been lost
    /// with a connection. One that stops, or asks, goes to the gateway present then; all others
    /// only to the one that they were given to, and are answered with Timeout when it was replaced.
    std::chrono::milliseconds repeat{250};
    struct Gateway {
      std::uint64_t session = 0;
      std::optional<std::chrono::microseconds>
          steady_ahead;  ///< of the server's; never overestimated
    };
    /// The present gateway of a machine; absent: commands keep their session.
    std::function<Gateway(const std::string& machine)> gateway_of{};
  };
  /// `on_late_start`: a start was accepted after its sender gave up; called on a DDS thread.
  CommandDispatcher(dds::ServerEndpoint& endpoint, const Clock& clock, Options options,
                    std::function<void(const dds::Command&)> on_late_start);

  /// How a command came to the server.
  struct Origin {
    std::optional<SteadyTime> given = {};  ///< absent: now
    bool is_stop = false;                  ///< it makes the machine safer, as a lowered override
  };
  /// Gives the command an id and an expiry, sends it and waits. Any thread but DDS's. Errors: Busy
  /// (refused: the gateway's reason; it waited too long before), Conflict (a stop was given after
  /// it), Timeout (nothing heard in time, or before the server ended), NotFound (never announced).
  Result<void> carry_out(dds::Command command, const Origin& origin = {std::nullopt, false});
  /// A stop that is not sent, or not yet: what was given before it is not carried out any more.
  void note_stop(const std::string& machine, dds::CommandAction action,
                 std::optional<SteadyTime> given);
  /// Asks for values (CommandAction::Query): as carry_out; returns what the gateway answers.
  Result<std::string> ask(dds::Command query);
  /// As carry_out; returns how it was answered.
  Result<dds::CommandResult> result_of(dds::Command command, const Origin& origin) {
    return send_and_await(std::move(command), origin);
  }
  /// Without waiting for the result; for commands of the server itself.
  Result<void> send(dds::Command command);

  /// On a DDS thread; returns at once.
  void on_result(const dds::CommandResult& result);
  /// The machine shows this run: its start was accepted, even if the result was lost. The result
  /// may be on its way, with what people must know of the start: it is awaited for a moment.
  void on_run_seen(const std::string& machine, const std::string& run);
  /// Whether a caller waits for the start of this run.
  bool is_waiting_for(const std::string& run) const;
  /// Answers to what has been sent are awaited for a second more.
  void stop();
  bool is_stopping() const;

 private:
  /// By the server's clock.
  struct Times {
    SteadyTime given, deadline;
  };
  struct Waiting {
    dds::Command command;
    std::optional<dds::CommandResult> result;
    Times times;
    bool is_seen = false;  ///< the machine shows the run that this starts
  };
  std::chrono::milliseconds life_of(const dds::Command& command) const;
  bool is_replaced(const dds::Command& command) const;
  Times stamp(dds::Command& command, const Origin& origin);
  Result<void> take_turn(dds::Command& command, const Origin& origin);
  Result<void> send_to_present(dds::Command command, const Times& times);
  Result<void> write_in_time(const dds::Command& command, const Times& times);
  Result<dds::CommandResult> await(const std::string& id);
  Result<dds::CommandResult> send_and_await(dds::Command command, const Origin& origin);

  const std::uint64_t session_;  ///< of this server
  dds::ServerEndpoint& endpoint_;
  const Clock& clock_;
  const Options options_;
  const std::function<void(const dds::Command&)> on_late_start_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Waiting> waiting_;
  std::deque<dds::Command> given_up_;  ///< starts without an answer, the newest kMaxGivenUp
  std::uint64_t last_number_ = 0;
  StopOrder stops_;
  bool is_stopping_ = false;
};

}  // namespace dripline::machines
