#pragma once

#include <optional>
#include <string>

#include "gateway/app/command_log.hpp"
#include "gateway/app/memory/position_setter.hpp"
#include "gateway/app/options.hpp"
#include "gateway/app/panel/consent.hpp"
#include "gateway/interpreter/core/jog_move.hpp"

namespace dripline::gateway {

/// Moves one axis by one finite step on an operator's command, while no program runs; one step at a
/// time. It never continues or repeats one: whatever becomes of the link, the server or this
/// process, a step ends by itself, and the next needs a command of its own. A held jog is such a
/// step that stops, wherever it is, when it is not kept for kHeld. A device, which would finish
/// what it has without this process, has it in pieces of kHeld. One thread.
class Jogger {
 public:
  struct Parts {
    const GatewayOptions& options;
    const interpreter::Dialect& dialect;
    const interpreter::Setup& setup;  ///< the gateway's own
    const Clock& clock;
    machine::MotionBackend& machine;
    const PositionSetter& positions;
    const Consent& consent;
    const CurrentRun& run;
    bool has_line = false;  ///< programs come from a line
  };
  /// All references must outlive it.
  explicit Jogger(Parts parts) : parts_(parts) {}

  /// A command with consent, in time, that was not answered before. Why it is refused; nothing: the
  /// axis moves, and `take_answer` has the answer later.
  std::optional<Reply> begin(const dds::Command& command);
  /// Lets it move, and ends what takes too long.
  void step(SteadyTime now);
  /// A held jog is still wanted. Never begins one, nor continues one that stops.
  Reply keep(std::string_view hold);
  /// Slows down and drops the rest; `why` is in the answer.
  void stop(std::string_view why);
  bool is_active() const { return step_.has_value(); }
  /// The step that moves was asked for by this command, which has come again.
  bool is_of(const std::string& command) const { return step_ && step_->command == command; }

  struct Answer {
    std::string command;
    Reply reply;
  };
  /// Of the step that has ended; once.
  std::optional<Answer> take_answer() { return std::exchange(answer_, std::nullopt); }
  /// For the status; nothing: this machine is not jogged.
  std::optional<dds::JogStatus> status() const;

  /// A step that would take longer at its feed is refused, in seconds.
  static constexpr double kLongest = 10;
  /// An axis may be slower than the feed: so long after kLongest the step is stopped, and then
  /// given up.
  static constexpr std::chrono::seconds kLate{2};
  /// How long a held jog moves without being kept.
  static constexpr std::chrono::milliseconds kHeld{300};

 private:
  struct Step {
    std::string command;
    interpreter::JogMove asked;
    machine::Jog jog;               ///< all of it
    double from = 0, distance = 0;  ///< of the axis, mm or degrees
    double given = 0;               ///< of the distance, to the machine
    SteadyTime last, limit;
    SteadyTime held_until;  ///< of a held jog
    std::string why_stopped;
  };
  std::string refusal() const;
  Result<void> begin_step(const dds::Command& command);
  Result<void> check_size(const interpreter::JogMove& move) const;
  bool is_diameter(interpreter::Axis axis) const;
  interpreter::LengthDisplay display(const interpreter::JogMove& move) const;
  Result<void> give_piece(Step& step);
  bool has_next_piece();
  std::string why_stopped() const;
  Reply ended() const;
  void answer(Reply reply);

  Parts parts_;
  std::optional<Step> step_;
  std::optional<Answer> answer_;
};

inline constexpr std::string_view kIsJogging = "the machine is being jogged";

}  // namespace dripline::gateway
