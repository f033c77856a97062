#pragma once

#include "gateway/machine/impl/action_queue.hpp"
#include "gateway/machine/impl/move_builder.hpp"

namespace dripline::machine::impl {

/// Makes queued actions of the interpreter's events. An impossible move is found here and queued as
/// an alarm in its place, so it is reached in sequence. After an alarm no event is taken.
class MotionQueueBuilder final : public interpreter::EventSink {
 public:
  MotionQueueBuilder(const MachineLimits& limits, ActionQueue& queue);

  void begin(const Coordinates& at);
  /// After begin: it runs already.
  void continue_spindle(const interpreter::Spindle& spindle) { spindle_.set(spindle); }
  void begin_probe(const interpreter::Probe& probe);
  /// Where the open probe has ended; what follows starts there.
  void end_probe(const Coordinates& at);
  /// Takes nothing more until begin().
  void close() { is_closed_ = true; }
  /// Of one block since begin(), in bytes.
  std::size_t largest_text() const { return largest_text_; }

  void on_program(const interpreter::ProgramHeader& header) override {
    builder_.show_as({.units = header.units, .x_is_diameter = header.x_is_diameter});
  }
  void on_units(const interpreter::UnitsChange& event) override {
    builder_.show_as({.units = event.units, .x_is_diameter = builder_.display().x_is_diameter});
  }
  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
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
  void on_stop(const interpreter::Stop& event) override;
  void on_override_inhibit(const interpreter::OverrideInhibit& event) override {
    lock_ = lock_of(event);
  }
  void on_warning(const interpreter::Warning& event) override;
  void on_alarm(const interpreter::Alarm& event) override;
  void on_end(const interpreter::End& event) override;
  void on_block_end(const interpreter::Origin& origin) override;

 private:
  /// Absent when closed, or when full: then an alarm takes the last place.
  Action* add(const interpreter::Origin& origin);
  void alarm(const interpreter::Origin& origin, std::string_view id, std::string text);
  void add_alarm(const interpreter::Origin& origin, interpreter::Diagnostic diagnostic);
  void add_text(const interpreter::Origin& origin, Text text, std::string_view content);
  void add_straight(const interpreter::Origin& origin, const interpreter::Position& to,
                    MoveTask task);
  void add_move(const interpreter::Origin& origin, const MoveTask& task);
  template <class Event>
  void add_as_is(const Event& event);

  ActionQueue& queue_;
  MoveBuilder builder_;
  SpindleModel spindle_;  ///< as programmed at the end of the queue
  Coordinates end_{};     ///< where the queued motion ends
  Lock lock_;             ///< of what comes next
  bool is_closed_ = false;
  std::uint64_t text_block_ = 0;  ///< whose text was queued last
  std::size_t block_text_ = 0, largest_text_ = 0;
};

}  // namespace dripline::machine::impl
