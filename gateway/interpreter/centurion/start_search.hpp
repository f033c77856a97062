#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/centurion/event_filter.hpp"
#include "gateway/interpreter/centurion/modal_state.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter::centurion {

struct Run;

/// Where a run begins when not at its first block: `N120` the first block with this number, `T3`
/// the first with this tool, `L40` the line, `B4096` the first block at or behind the byte (a run
/// that was cut off goes on there), `+25` after as many blocks.
struct StartAt {
  enum class Kind : std::uint8_t { Block, Tool, Line, Byte, Count };
  Kind kind = Kind::Block;
  std::uint64_t number = 0;
  std::string text;  ///< as written
};
/// Errors: Syntax.
Result<StartAt> parse_start_at(std::string_view text);

/// Looks for the start through everything the program does before it: nothing of that reaches the
/// machine, but all of it counts (modes, zeros, parameters, tool). At the start the tool, spindle
/// and coolant are shown, and the machine moves from where it stands to where the program is by way
/// of the clearance plane (spec 24.3). A program that has no such place begins at its first block,
/// with a message.
class StartSearch final : public EventFilter {
 public:
  StartSearch(EventSink& out, StartAt start) : EventFilter(out), start_(std::move(start)) {}
  /// `state` holds what has to survive a snapshot; it must outlive this.
  void attach(ModalState& state) { state_ = &state; }

  bool is_searching() const { return state_->is_searching; }
  /// Asked before a block is read, and with its tool when it has been.
  bool is_here(const Run& run, std::optional<std::uint32_t> sequence) const;
  bool is_tool(int tool) const;
  void begin_here(Run& run);
  void begin_at_first(Run& run);

  void on_rapid(const Rapid& event) override;
  void on_line(const Line& event) override;
  void on_arc(const Arc& event) override;
  void on_thread(const Thread& event) override;
  void on_dwell(const Dwell& event) override { pass(&EventSink::on_dwell, event); }
  void on_spindle(const Spindle& event) override { pass(&EventSink::on_spindle, event); }
  void on_coolant(const Coolant& event) override { pass(&EventSink::on_coolant, event); }
  void on_tool(const ToolChange& event) override { pass(&EventSink::on_tool, event); }
  void on_miscellaneous(const Miscellaneous& event) override {
    pass(&EventSink::on_miscellaneous, event);
  }
  void on_pin(const PinChange& event) override { pass(&EventSink::on_pin, event); }
  void on_probe(const Probe& event) override { pass(&EventSink::on_probe, event); }
  void on_output(const Output& event) override { pass(&EventSink::on_output, event); }
  void on_open(const Open& event) override { pass(&EventSink::on_open, event); }
  void on_close(const Close& event) override { pass(&EventSink::on_close, event); }
  void on_message(const Message& event) override { pass(&EventSink::on_message, event); }
  void on_prompt(const Prompt& event) override { pass(&EventSink::on_prompt, event); }
  void on_stop(const Stop& event) override { pass(&EventSink::on_stop, event); }
  void on_panel_lock(const PanelLock& event) override { pass(&EventSink::on_panel_lock, event); }
  void on_warning(const Warning& event) override { pass(&EventSink::on_warning, event); }
  void on_end(const End& event) override { pass(&EventSink::on_end, event); }
  void on_block_end(const Origin& event) override { pass(&EventSink::on_block_end, event); }

 private:
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    if (!state_->is_searching) (out().*deliver)(event);
  }
  template <class Event>
  void move(void (EventSink::*deliver)(const Event&), const Event& event);
  void approach(Run& run, const Point& from, const Point& to);

  const StartAt start_;
  ModalState* state_ = nullptr;
};

}  // namespace dripline::interpreter::centurion
