#include "gateway/app/jog/jogger.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gateway/app/run/run_loop.hpp"
#include "gateway/app/run/run_texts.hpp"

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::JogMove;

namespace {

constexpr double kReached = 0.01;  ///< mm or degrees: a device moves by whole steps

SteadyTime::duration steady_seconds(double count) {
  return std::chrono::duration_cast<SteadyTime::duration>(std::chrono::duration<double>(count));
}

std::string_view unit_of(const JogMove& move) {
  if (interpreter::is_rotary(move.axis)) return "deg";
  return move.units == interpreter::Units::Inch ? "in" : "mm";
}

/// In the unit of the command, X of a lathe as a diameter.
double in_unit(const JogMove& move, double value) {
  return unit_of(move) == "in" ? Length::mm(value).inch() : value;
}

}  // namespace

/// As for a program that begins, without what the command itself has.
std::string Jogger::refusal() const {
  const machine::MotionBackend& machine = parts_.machine;
  if (!machine.capabilities().jog) return "this machine moves by programs alone: it is not jogged";
  if (parts_.has_line) return "this machine takes its programs from a line: it is jogged there";
  if (parts_.options.jog_step <= 0)
    return "the gateway allows no jog from the network (jog-step is 0)";
  if (step_) return std::string(kIsJogging);
  if (parts_.run.session)
    return fmt::format("run {} is active: nothing is jogged while a program runs",
                       parts_.run.session->run().run);
  const machine::OperatorPanel& panel = machine.panel();
  if (panel.emergency_stop) return std::string(kEmergencyStop);
  if (panel.machine_lock) return "machine lock is on: the axes do not move";
  if (panel.feed_override == 0) return "the feed override is 0";
  if (!parts_.consent.is_given()) return std::string(kNoConsent);
  const auto ready = machine.check_begin(machine.status().axes());
  return ready ? std::string() : ready.error().what;
}

std::optional<dds::JogStatus> Jogger::status() const {
  if (!parts_.machine.capabilities().jog || parts_.has_line) return std::nullopt;
  return dds::JogStatus{.step = parts_.options.jog_step,
                        .feed = parts_.options.jog_feed,
                        .is_moving = step_.has_value(),
                        .refusal = valid_text(refusal(), kMaxReason)};
}

std::optional<Reply> Jogger::begin(const dds::Command& command) {
  if (std::string why = refusal(); !why.empty()) return refuse(std::move(why));
  const auto begun = begin_step(command);
  return begun ? std::nullopt : std::optional(refuse(begun.error().what));
}

bool Jogger::is_diameter(Axis axis) const {
  return axis == Axis::X && parts_.dialect.machine == interpreter::MachineKind::Lathe;
}

interpreter::LengthDisplay Jogger::display(const JogMove& move) const {
  return {.units = move.units, .x_is_diameter = is_diameter(Axis::X)};
}

/// By the gateway's limits, which are of the axis: of X of a lathe the diameter is twice that.
Result<void> Jogger::check_size(const JogMove& move) const {
  constexpr double kRounding = 1e-9;
  const GatewayOptions& limits = parts_.options;
  const double size = std::fabs(move.canonical());
  const double feed = move.canonical_feed().value_or(limits.jog_feed);
  if (size > limits.jog_step + kRounding) {
    return fail(Errc::LimitExceeded, "a step of {:.6g} {}: this gateway takes {:.6g} at most",
                std::fabs(move.distance), unit_of(move), in_unit(move, limits.jog_step));
  }
  if (feed > limits.jog_feed + kRounding) {
    return fail(Errc::LimitExceeded, "a feed of {:.6g} {}/min: this gateway takes {:.6g} at most",
                *move.feed, unit_of(move), in_unit(move, limits.jog_feed));
  }
  const double takes = size / feed * 60;
  if (takes <= kLongest) return {};
  return fail(Errc::LimitExceeded, "the step would take {:.3g} s: {:.3g} s at most", takes,
              kLongest);
}

Result<void> Jogger::begin_step(const dds::Command& command) {
  const auto move = interpreter::parse_jog_move(command.argument);
  if (!move) return fail(move.error());
  if (auto fits = check_size(*move); !fits) return fits;
  const double distance = move->canonical() / (is_diameter(move->axis) ? 2 : 1);
  if (auto allowed = parts_.positions.check_jog(move->axis, distance, command.setup); !allowed)
    return allowed;
  const machine::Jog jog{
      .axis = move->axis,
      .distance = distance,
      .feed_per_minute = move->canonical_feed().value_or(parts_.options.jog_feed),
      .display = display(*move)};
  const double from = parts_.machine.status().position.raw(move->axis);
  const SteadyTime now = parts_.clock.steady_now();
  const double factor = parts_.options.speed.factor.value_or(1);
  const double takes = std::fabs(distance) / jog.feed_per_minute * 60 / std::min(factor, 1.0);
  Step step = {.command = command.id,
               .asked = *move,
               .jog = jog,
               .from = from,
               .distance = distance,
               .given = 0,
               .last = now,
               .limit = now + steady_seconds(std::max(takes, kLongest)) + kLate,
               .held_until = now + kHeld,
               .why_stopped = {}};
  if (auto begun = give_piece(step); !begun) return begun;
  step_ = std::move(step);
  return {};
}

/// A step is one; so is a held jog of axes that stop with this process.
Result<void> Jogger::give_piece(Step& step) {
  constexpr double kSmallest = 0.05;  // mm or degrees: some steps of a device
  machine::Jog piece = step.jog;
  piece.distance = step.distance - step.given;
  if (!step.asked.hold.empty() && !parts_.machine.capabilities().simulated_time) {
    const double held = std::chrono::duration<double>(kHeld).count() * piece.feed_per_minute / 60;
    const double size = std::max(held, kSmallest);
    if (std::fabs(piece.distance) > size) piece.distance = std::copysign(size, piece.distance);
  }
  if (auto begun = parts_.machine.jog(piece); !begun) return begun;
  step.given += piece.distance;
  return {};
}

/// Only from where the last one was to end, at rest.
bool Jogger::has_next_piece() {
  constexpr double kNothing = 1e-9;
  if (std::fabs(step_->distance - step_->given) <= kNothing) return false;
  if (!step_->why_stopped.empty() || !parts_.machine.jog_fault().empty()) return false;
  const double moved = parts_.machine.status().position.raw(step_->asked.axis) - step_->from;
  if (std::fabs(moved - step_->given) > kReached) return false;
  const auto given = give_piece(*step_);
  const machine::OperatorPanel& panel = parts_.machine.panel();
  const bool may_move = !panel.emergency_stop && panel.feed_override != 0;
  // A device shows the end of the last one a moment later than its axes rest.
  if (!given && given.error().code == Errc::Busy && may_move) return true;
  if (!given) step_->why_stopped = "since " + given.error().what;
  return given.has_value();
}

void Jogger::step(SteadyTime now) {
  if (!step_) return;
  if (!step_->asked.hold.empty() && now > step_->held_until) stop("since it was no longer held");
  if (parts_.machine.capabilities().simulated_time) {
    const auto elapsed =
        std::clamp<SteadyTime::duration>(now - step_->last, {}, RunLoop::kLongestStep);
    step_->last = now;
    const auto& factor = parts_.options.speed.factor;
    (void)parts_.machine.poll(
        machine::Seconds{factor ? std::chrono::duration<double>(elapsed).count() * *factor
                                : std::numeric_limits<double>::infinity()},
        machine::MotionBackend::kNoLimit);
  }
  if (!parts_.machine.is_jogging() && !has_next_piece()) return answer(ended());
  if (now > step_->limit + kLate)
    return answer(refuse("the axis does not come to rest: look at the machine"));
  if (now > step_->limit) stop("because its time was over");
}

Reply Jogger::keep(std::string_view hold) {
  if (!step_ || step_->asked.hold != hold) return refuse("no jog is held by that word");
  if (!step_->why_stopped.empty()) return refuse("the jog stops " + step_->why_stopped);
  const SteadyTime now = parts_.clock.steady_now();
  if (now > step_->held_until) return refuse("the jog was not kept in time");
  step_->held_until = now + kHeld;
  return {};
}

void Jogger::stop(std::string_view why) {
  if (!step_) return;
  if (step_->why_stopped.empty()) step_->why_stopped = why;
  parts_.machine.stop_jog();
}

void Jogger::answer(Reply reply) {
  answer_ = Answer{step_->command, std::move(reply)};
  step_.reset();
}

std::string Jogger::why_stopped() const {
  const machine::OperatorPanel& panel = parts_.machine.panel();
  if (panel.emergency_stop) return "by the emergency stop";
  if (panel.feed_override == 0) return "by the feed override";
  return step_->why_stopped.empty() ? "at the machine" : step_->why_stopped;
}

/// Where the axis is now; a step that was stopped is done as far as it has come.
Reply Jogger::ended() const {
  const JogMove& move = step_->asked;
  const double at = parts_.machine.status().position.raw(move.axis);
  const double moved = at - step_->from;
  const bool is_reached =
      std::fabs(moved - step_->distance) <= std::min(kReached, std::fabs(step_->distance) / 2);
  const std::string fault = parts_.machine.jog_fault();
  const interpreter::LengthDisplay shown = display(move);
  const std::string place = fmt::format("{} {}", interpreter::shown_axis(move.axis, at, shown),
                                        interpreter::shown_unit(move.axis, move.units));
  if (!fault.empty() && !is_reached)
    return refuse(
        valid_text(fmt::format("{}; the last position known is {}", fault, place), kMaxReason));
  const double scale = is_diameter(move.axis) ? 2 : 1;
  nlohmann::json details{{"axis", std::string(1, interpreter::letter(move.axis))},
                         {"position", in_unit(move, at * scale)},
                         {"moved", in_unit(move, moved * scale)},
                         {"unit", unit_of(move)},
                         {"reached", is_reached}};
  const std::string text = is_reached ? place : fmt::format("{}, stopped {}", place, why_stopped());
  return {true, valid_text(text, kMaxReason), details.dump()};
}

}  // namespace dripline::gateway
