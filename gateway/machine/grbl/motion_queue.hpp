#pragma once

#include <deque>
#include <string>
#include <variant>
#include <vector>

#include "gateway/machine/execution_sink.hpp"
#include "gateway/machine/grbl/line_writer.hpp"
#include "gateway/machine/machine_status.hpp"

namespace dripline::machine::grbl {

/// Lines that move the axes; they are streamed, also many blocks of them ahead.
struct Motion {
  std::vector<std::string> lines;
  Coordinates end{};
  MotionKind kind = MotionKind::None;
  std::size_t sent = 0;           ///< of the lines
  std::uint64_t last_serial = 0;  ///< of the last line, when all are sent
};
/// What the board does at standstill: spindle, coolant, a dwell.
struct BoardCommand {
  std::vector<std::string> lines;
  std::variant<interpreter::Spindle, interpreter::Coolant, interpreter::Dwell> event;
  bool is_sent = false;
};
struct ProbeMove {
  interpreter::Probe probe;
  MotionText text;
  bool is_sent = false, is_returning = false;
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
  std::variant<BlockEnd, Motion, BoardCommand, ProbeMove, TextEvent, interpreter::ToolChange,
               interpreter::Miscellaneous, interpreter::Stop, interpreter::OverrideInhibit,
               interpreter::End, AlarmEvent>
      body;
};

/// Makes actions of the interpreter's events, on the owner's thread. What the board cannot do
/// becomes an alarm in its place; after it nothing is taken.
///
/// The board changes no tools: a tool change for which the program itself does not wait gets a
/// stop, before the next motion and at the latest at the end of its block, with the spindle
/// switched off meanwhile.
class QueueBuilder final : public interpreter::EventSink {
 public:
  explicit QueueBuilder(LineWriter writer) : writer_(std::move(writer)) {}

  void begin(LineWriter writer, const Coordinates& at);
  void close() { is_closed_ = true; }
  LineWriter& writer() { return writer_; }
  std::deque<Action> take() { return std::exchange(made_, {}); }
  std::size_t size() const { return made_.size(); }
  void begin_probe(const interpreter::Probe& probe);

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
  void add_motion(const interpreter::Origin& origin, MotionKind kind, MotionText text,
                  std::optional<Refusal> refusal);
  void add_text(const interpreter::Origin& origin, TextEvent text);
  void want_tool();
  void stop_for_tool(const interpreter::Origin& origin);
  bool begin_motion(const interpreter::Origin& origin);
  void add_spindle(const interpreter::Spindle& event);

  LineWriter writer_;
  std::deque<Action> made_;
  interpreter::OverrideInhibit inhibit_;
  interpreter::Spindle spindle_;  ///< as commanded last
  std::optional<int> tool_;       ///< that the program has changed to
  bool wants_tool_ = false;       ///< the operator must change it before the axes move
  bool has_stopped_ = false;      ///< since the last motion: there was time for it
  bool is_closed_ = false;
};

}  // namespace dripline::machine::grbl
