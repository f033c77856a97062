#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/app/position_fixture.hpp"

namespace dripline::gateway {

class JogShop : public Shop {
 public:
  explicit JogShop(const interpreter::Dialect& control, const std::string& toml = "",
                   const std::string& speed = "1x")
      : Shop(control, toml, speed) {
    allow_jogs(100, 6000);
  }
  dds::Command jog_command(const std::string& move) {
    dds::Command command = this->command(dds::CommandAction::Jog);
    command.run.clear();
    command.argument = move;
    command.setup = server_setup;
    return command;
  }
  /// Where it is when it has ended, or "refused: " and why.
  std::string jog(const std::string& move) { return answer_to(jog_command(move)); }
  std::string answer_to(const dds::Command& command) {
    const auto reply = send(command);
    return (reply.accepted ? "" : "refused: ") + reply.reason;
  }
  /// Begun, and not awaited.
  dds::Command begin(const std::string& move) {
    const dds::Command command = jog_command(move);
    gateway->receive(command, clock.steady);
    return command;
  }
  void pass(std::chrono::milliseconds time) {
    const SteadyTime until = clock.steady + time;
    (void)run_until([&] { return clock.steady >= until; });
  }
  std::string end_of(const dds::Command& command) {
    if (!run_until([&] { return results.count(command.id) > 0; })) return "no answer";
    return (results[command.id].accepted ? "" : "refused: ") + results[command.id].reason;
  }
  dds::Command stop() {
    dds::Command command = this->command(dds::CommandAction::Abort);
    command.run.clear();
    command.argument = dds::kJogAbort;
    return command;
  }
  std::string refusal() const {
    return gateway->status().jog ? gateway->status().jog->refusal : "none";
  }
};

}  // namespace dripline::gateway
