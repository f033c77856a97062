#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialects.hpp"
#include "protocol/dds/record_text.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

namespace dripline::gateway {

/// A gateway whose operator keys in blocks, and takes over where the axes are.
class Shop : public GatewayFixture {
 public:
  explicit Shop(const interpreter::Dialect& control, const std::string& toml = "",
                const std::string& speed = "max")
      : GatewayFixture(control, setup_from(toml), speed) {}

  dds::CommandResult ask(dds::CommandAction action, const std::string& argument) {
    dds::Command command = this->command(action);
    command.run.clear();
    command.argument = argument;
    command.program = "anna";
    command.setup = server_setup;
    last_id_ = command.id;
    return send(command);
  }
  /// What was set, or "refused: " and why.
  std::string set(const std::string& argument) {
    const auto reply = ask(dds::CommandAction::SetPosition, argument);
    return (reply.accepted ? "" : "refused: ") + reply.reason;
  }
  std::string playback(const std::string& axes) {
    const auto reply = ask(dds::CommandAction::Playback, axes);
    return (reply.accepted ? "" : "refused: ") + reply.reason;
  }
  std::string run(const std::string& text, bool is_mdi = false) {
    const std::string name = "P" + std::to_string(++texts_);
    push(name, text);
    dds::Command command = start_command(name);
    if (is_mdi) command.argument = dds::kMdiStart;
    command.setup = server_setup;
    const auto reply = send(command);
    if (!reply.accepted) return "refused: " + reply.reason;
    const std::size_t before = count(dds::RecordKind::RunEnded);
    (void)run_until(
        [&] { return count(dds::RecordKind::RunEnded) > before && gateway->status().run.empty(); });
    const auto end = *dds::decode_run_end(records.back().text);
    return end.outcome == dds::RunOutcome::Completed ? "completed" : end.reason;
  }
  std::string mdi(const std::string& text) { return run(text, true); }
  /// Starts it, and aborts it when `is_there`.
  std::string abort_when(const std::string& text, const std::function<bool()>& is_there) {
    const std::string name = "P" + std::to_string(++texts_);
    push(name, text);
    dds::Command command = start_command(name);
    command.argument = dds::kMdiStart;
    const auto reply = send(command);
    if (!reply.accepted) return "refused: " + reply.reason;
    if (!run_until(is_there)) return "it never came there";
    dds::Command abort = this->command(dds::CommandAction::Abort);
    abort.run = command.run;
    (void)send(abort);
    (void)run_until([&] { return gateway->status().run.empty(); });
    return dds::decode_run_end(records.back().text)->reason;
  }
  double at(std::size_t axis) const { return gateway->status().position[axis]; }
  /// The reports of the memory since the last call.
  std::vector<dds::Record> memory_records() {
    std::vector<dds::Record> found;
    for (; seen_ < records.size(); ++seen_)
      if (records[seen_].device == "memory") found.push_back(records[seen_]);
    return found;
  }
  std::string last_id() const { return last_id_; }

  std::string server_setup;

 private:
  int texts_ = 0;
  std::size_t seen_ = 0;
  std::string last_id_;
};

}  // namespace dripline::gateway
