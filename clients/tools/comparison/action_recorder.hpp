#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/tools/comparison/action.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/interpreter.hpp"

namespace dripline::comparison {

/// Keeps the actions of a program until they are compared: a queue whose storage is used again.
class ActionQueue {
 public:
  bool empty() const { return head_ == tail_; }
  std::size_t size() const { return tail_ - head_; }
  const Action& operator[](std::size_t i) const { return actions_[head_ + i]; }
  void drop(std::size_t count);
  /// A new last one, with the defaults of an action.
  Action& push();
  Action& back() { return actions_[tail_ - 1]; }
  void swap_last_two() { std::swap(actions_[tail_ - 1], actions_[tail_ - 2]); }
  void drop_back() { --tail_; }

 private:
  std::vector<Action> actions_;
  std::size_t head_ = 0, tail_ = 0;
};

/// Makes actions of events. Left out: moves without length that are no full circles, what only
/// draws (blanks), units, warnings, and, across controls, what belongs to a control (README.md).
class ActionRecorder final : public interpreter::EventSink {
 public:
  ActionRecorder(ActionQueue& queue, const interpreter::Position& start, bool across_controls)
      : queue_(queue), at_(start), across_controls_(across_controls) {}

  /// Whose modes say which length of the tool is in force. It must outlive the events.
  void watch(const interpreter::Interpreter& interpreter) { interpreter_ = &interpreter; }
  std::uint64_t blocks() const { return blocks_; }
  /// How many texts had a block that was executed: the program and those it calls.
  interpreter::ProgramIndex programs() const { return programs_; }
  /// Of the block that caused the alarm.
  std::uint64_t alarm_offset() const { return alarm_offset_; }

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_probe(const interpreter::Probe& event) override;
  void on_dwell(const interpreter::Dwell& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_pin(const interpreter::PinChange& event) override;
  void on_output(const interpreter::Output& event) override;
  void on_open(const interpreter::Open& event) override;
  void on_close(const interpreter::Close& event) override;
  void on_message(const interpreter::Message& event) override;
  void on_prompt(const interpreter::Prompt& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_override_inhibit(const interpreter::OverrideInhibit& event) override;
  void on_alarm(const interpreter::Alarm& event) override;
  void on_end(const interpreter::End& event) override;
  void on_block_end(const interpreter::Origin& origin) override {
    ++blocks_;
    if (origin.program >= programs_) programs_ = origin.program + 1;
  }

 private:
  Action& push(ActionKind kind, const interpreter::Origin& origin);
  Action& move(ActionKind kind, const interpreter::Origin& origin, const interpreter::Position& to);
  void set_arc(Action& action, const interpreter::Arc& arc);
  void set_in_step(Action& move) const;
  void note_turn(interpreter::SpindleState state);
  bool is_repeated(const Action& state, Action& last, bool& is_known);

  ActionQueue& queue_;
  const interpreter::Interpreter* interpreter_ = nullptr;
  interpreter::Position at_;
  bool across_controls_;
  std::uint64_t blocks_ = 0;
  interpreter::ProgramIndex programs_ = 1;
  std::uint64_t alarm_offset_ = 0;
  Action spindle_, coolant_;  ///< in force
  bool is_spindle_known_ = false, is_coolant_known_ = false;
  bool is_feed_fixed_ = false;  ///< the operator's override is inhibited: a thread is cut
  std::optional<interpreter::SpindleState> turn_;  ///< the last sense it had
  bool is_cutting_ = false;                        ///< the last move was no rapid
  bool is_reversed_ = false;                       ///< since the last rapid, after a cut
};

}  // namespace dripline::comparison
