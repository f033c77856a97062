#pragma once

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/machine/grbl/grbl_machine.hpp"
#include "tests/support/grbl/board.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

namespace dripline::gateway {

/// A gateway with a board of the Grbl class, whose operator puts in the tool that a stop asks for.
/// It reads what the board is sent: which tool goes where, in coordinates of the board.
class BoardShop : public GatewayFixture {
 public:
  struct Move {
    std::array<double, 3> from{}, to{};
    bool is_rapid = false;
    std::optional<int> tool;  ///< in the spindle
    bool goes_across() const { return from[0] != to[0] || from[1] != to[1]; }
  };
  struct ToolStop {
    double z = 0;
    std::optional<int> out, in;
  };

  BoardShop(const std::string& toml, test_support::GrblBoard::Options options)
      : GatewayFixture(interpreter::kFanucDialect, setup_from(toml), "1x"),
        board(std::move(options)) {
    for (std::size_t i = 0; i < 3; ++i) at_[i] = board.position()[i];
    set_checkpoint_interval(std::chrono::milliseconds(200));
    motion = [this](machine::ExecutionSink& sink) {
      auto made = std::make_unique<machine::grbl::GrblMachine>(machine::grbl::GrblMachine::Settings{
          .sink = sink, .clock = std::shared_ptr<const Clock>(&clock, [](const auto*) {})});
      machine = made.get();
      machine->line_opened();
      return made;
    };
    each_turn = [this] {
      for (int i = 0; i < 10; ++i) {
        board.pass(0.001);
        const std::string in = board.take_output();
        const auto out = machine->exchange(std::as_bytes(std::span(in)));
        board.receive(out.real_time + out.lines);
      }
      read_lines();
    };
    restart_gateway();
    (void)run_until([&] { return status && machine->notice().empty(); });
  }

  /// Its run; empty: refused.
  std::string start_run(const std::string& text) {
    push("P", text);
    const dds::Command start = start_command("P");
    answer = send(start);
    return answer.accepted ? start.run : std::string();
  }
  /// As an operator would, until `done` or the end of the run.
  bool run_on(const std::function<bool()>& done) {
    const std::size_t ended = count(dds::RecordKind::RunEnded);
    for (int i = 0; i < 60'000; ++i) {
      (void)run_until([&] { return true; });
      clock.steady += std::chrono::milliseconds(10);
      each_turn();
      if (done()) return true;
      if (count(dds::RecordKind::RunEnded) > ended) return false;
      if (status && status->execution == dds::Execution::ProgramStopped) change_tool();
    }
    return false;
  }
  void abort() {
    (void)send(command(dds::CommandAction::Abort));
    (void)run_until([&] { return gateway->status().run.empty() && !board.is_moving(); });
    (void)run_until([] { return false; }, std::chrono::milliseconds(200));
    for (std::size_t i = 0; i < 3; ++i) at_[i] = board.position()[i];
  }
  /// The report; null: refused.
  nlohmann::json restart(const std::string& run, const std::string& at) {
    dds::Command start = start_command("P");
    start.argument = "restart=" + run + " at=" + at;
    answer = send(start);
    if (!answer.accepted) return {};
    const dds::Record* report = nullptr;
    (void)run_until([&] {
      for (const dds::Record& record : records)
        if (record.run == start.run && record.device == "restart") report = &record;
      return report != nullptr || gateway->status().run.empty();
    });
    moves.clear();
    stops.clear();
    return report == nullptr ? nlohmann::json() : nlohmann::json::parse(report->text);
  }

  test_support::GrblBoard board;
  machine::grbl::GrblMachine* machine = nullptr;
  dds::CommandResult answer;
  std::vector<Move> moves;
  std::vector<ToolStop> stops;
  std::optional<int> tool;  ///< in the spindle

 private:
  void change_tool() {
    const ToolStop stop{board.position()[2], tool, machine->status().tool};
    tool = stop.in;
    if (send(command(dds::CommandAction::Resume)).accepted)
      stops.push_back(stop);
    else
      tool = stop.out;  // its resume was sent before
  }
  static std::optional<double> word(const std::string& line, char letter) {
    const std::size_t at = line.find(letter);
    double value = 0;
    if (at == std::string::npos) return std::nullopt;
    std::from_chars(line.data() + at + 1, line.data() + line.size(), value);
    return value;
  }
  void read_lines() {
    for (; read_ < board.lines.size(); ++read_) {
      const std::string& line = board.lines[read_];
      if (line.starts_with("$")) continue;
      Move move{at_, at_, false, tool};
      for (std::size_t i = 0; i < 3; ++i)
        if (const auto value = word(line, "XYZ"[i])) move.to[i] = *value;
      if (move.to == move.from) continue;
      move.is_rapid = line.find("G0") != std::string::npos;
      at_ = move.to;
      moves.push_back(move);
    }
  }

  std::size_t read_ = 0;
  std::array<double, 3> at_{};
};

}  // namespace dripline::gateway
