#pragma once

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gateway/machine/given_action.hpp"
#include "gateway/machine/machine_status.hpp"
#include "gateway/machine/streamed/command_writer.hpp"
#include "gateway/machine/streamed/motion_writer.hpp"

namespace dripline::machine::streamed {

/// Lines that move the axes; they are streamed, also many blocks of them ahead.
struct Motion {
  std::vector<std::string> lines;
  Coordinates from{}, end{};
  double length = 0;  ///< of the path
  MotionKind kind = MotionKind::None;
  std::optional<GivenAction::Arc> arc = {};
  std::size_t sent = 0;           ///< of the lines
  std::uint64_t last_serial = 0;  ///< of the last line, when all are sent
};
/// What the device does at standstill. Without lines it is only reported.
struct Command {
  std::vector<std::string> lines;
  std::variant<interpreter::Spindle, interpreter::Coolant, interpreter::Dwell,
               interpreter::ToolChange, interpreter::Miscellaneous, interpreter::PinChange>
      event;
  std::size_t sent = 0;  ///< of the lines
};
struct ProbeMove {
  interpreter::Probe probe;
  MotionText text;
  bool is_sent = false, is_returning = false;
  bool is_there = false;  ///< the probe was as awaited before the move: there is none
};
/// What is only reported, when everything before it is done.
struct TextEvent {
  enum class Kind : std::uint8_t { Output, Open, OpenNamed, Close, Message, Warning };
  Kind kind = Kind::Message;
  interpreter::OutputDevice device{};
  std::string text = {};
  std::string_view id = {};
  std::uint64_t line = 0;
  std::uint32_t column = 0;
};
struct AlarmEvent {
  interpreter::Diagnostic diagnostic;
};
struct BlockEnd {};

struct Action {
  interpreter::Origin origin;
  bool ends_block = false;
  bool may_stop_after = true;  ///< single block is not inhibited
  double seconds = 0;          ///< at 100 % override
  ToolLengths lengths{};       ///< the program's position leaves them out
  std::variant<BlockEnd, Motion, Command, ProbeMove, TextEvent, interpreter::Stop,
               interpreter::OverrideInhibit, interpreter::End, AlarmEvent>
      body;
};

/// Makes actions of the interpreter's events, on the owner's thread. What the device cannot do
/// becomes an alarm in its place; after it nothing is taken. Events have positions of the program,
/// actions those of the axes: here the lengths of tools are added.
class QueueBuilder final : public interpreter::EventSink {
 public:
  explicit QueueBuilder(std::unique_ptr<CommandWriter> commands)
      : motion_(TextRules{}), commands_(std::move(commands)) {}

  void begin(const TextRules& rules, const Coordinates& at);
  void close() { is_closed_ = true; }
  void set_lengths(const ToolLengths& lengths) { lengths_ = lengths; }
  /// For a check: actions are made and dropped.
  void keep_nothing() { keeps_actions_ = false; }
  /// What the device cannot do, after which nothing is taken.
  const std::optional<interpreter::Diagnostic>& refusal() const { return refusal_; }
  MotionWriter& motion() { return motion_; }
  std::deque<Action> take() {
    lines_ = 0;
    return std::exchange(made_, {});
  }
  std::size_t size() const { return made_.size(); }
  /// Of the motion that is not taken yet.
  std::size_t lines() const { return lines_; }
  void begin_probe(const interpreter::Probe& probe);

  void on_program(const interpreter::ProgramHeader& header) override {
    motion_.show_as({.units = header.units, .x_is_diameter = header.x_is_diameter});
  }
  void on_units(const interpreter::UnitsChange& event) override {
    motion_.show_as({.units = event.units, .x_is_diameter = motion_.display().x_is_diameter});
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
  void on_override_inhibit(const interpreter::OverrideInhibit& event) override;
  void on_warning(const interpreter::Warning& event) override;
  void on_alarm(const interpreter::Alarm& event) override;
  void on_end(const interpreter::End& event) override;
  void on_block_end(const interpreter::Origin& origin) override;

 private:
  Action* add(const interpreter::Origin& origin);
  void refuse(const interpreter::Origin& origin, Refusal refusal);
  template <class Event>
  void add_motion(const Event& event, MotionKind kind,
                  std::optional<Refusal> (MotionWriter::*write)(const Event&, MotionText&));
  template <class Event>
  void add_command(const Event& event,
                   std::optional<Refusal> (CommandWriter::*write)(const Event&,
                                                                  CommandWriter::Lines&));
  void add_text(const interpreter::Origin& origin, TextEvent text);

  MotionWriter motion_;
  ToolLengths lengths_{};
  std::unique_ptr<CommandWriter> commands_;
  std::deque<Action> made_;
  std::size_t lines_ = 0;
  interpreter::OverrideInhibit inhibit_;
  std::optional<interpreter::Diagnostic> refusal_;
  bool is_closed_ = false, keeps_actions_ = true;
};

}  // namespace dripline::machine::streamed
