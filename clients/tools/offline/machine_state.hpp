#pragma once

#include <optional>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::interpreter {

/// The state of the machine after the last event: what a program has set so far. One thread.
class MachineState final : public EventSink {
 public:
  explicit MachineState(const Position& start = {}) : position_(start) {}

  const Position& position() const { return position_; }
  const std::optional<int>& tool() const { return tool_; }
  const std::optional<Feed>& feed() const { return feed_; }  ///< of the last move at feed
  const Spindle& spindle() const { return spindle_; }
  const Coolant& coolant() const { return coolant_; }
  const Origin& block() const { return block_; }  ///< finished last

  void on_rapid(const Rapid& event) override { position_ = event.to; }
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override { position_ = event.to; }
  void on_spindle(const Spindle& event) override { spindle_ = event; }
  void on_coolant(const Coolant& event) override { coolant_ = event; }
  void on_tool(const ToolChange& event) override;
  void on_probe(const Probe& event) override;
  void on_block_end(const Origin& event) override { block_ = event; }

 private:
  Position position_;
  std::optional<int> tool_;
  std::optional<Feed> feed_;
  Spindle spindle_;
  Coolant coolant_;
  Origin block_;
};

}  // namespace dripline::interpreter
