// A probe move, from its text to its result.
#include <algorithm>
#include <cmath>

#include "gateway/machine/streamed/streamed_machine.hpp"

namespace dripline::machine::streamed {

namespace {

/// Whether a straight move between the two passes `point`, within some steps.
bool is_on_path(const Coordinates& point, const Coordinates& from, const Coordinates& to) {
  constexpr double kSlack = 0.1;
  double square = 0, along = 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    square += (to[i] - from[i]) * (to[i] - from[i]);
    along += (to[i] - from[i]) * (point[i] - from[i]);
  }
  const double part = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (std::fabs(from[i] + (to[i] - from[i]) * part - point[i]) > kSlack) return false;
  return true;
}

}  // namespace

/// The move ends at the contact, as programs take it: the device brakes past it, and is moved back.
bool StreamedMachine::deliver_probe(Lock& lock) {
  if (!has_started_) return start_front(lock);
  auto& move = std::get<ProbeMove>(queue_.front().body);
  if (!has_begun_ && !check_position(expected_)) return device_.fault().has_value();
  has_begun_ = true;
  if (!device_.prepare(now())) return false;
  if (!move.is_sent && !move.text.lines.empty() && !move.is_there) {
    if (!device_.is_at_rest()) return false;
    const bool until_contact = move.probe.until == interpreter::ProbeUntil::Contact;
    if (device_.is_touching() == until_contact) {
      move.is_there = true;
      return true;
    }
    const std::string& line = move.text.lines.front();
    if (!device_.may_send(line.size())) return false;
    device_.drop_probe();
    device_.send(line, true, {});
    device_.await_execution();
    move.is_sent = true;
    return false;
  }
  if (!device_.is_at_rest()) return false;
  MotionWriter& writer = builder_.motion();
  const auto probed = device_.probe();
  if (move.is_sent && !probed) {
    device_.raise("MCH0009", "the probe move has ended without a result", now());
    return true;
  }
  const bool has_stopped = move.is_sent && probed->tripped;
  const bool tripped = has_stopped || move.is_there;
  const Coordinates end = has_stopped ? probed->at : move.is_there ? expected_ : move.text.end;
  if (has_stopped && !move.is_returning) {
    if (!is_on_path(end, expected_, move.text.end)) {
      device_.raise("MCH0009", "the machine reports a contact that is not on the probe's path",
                    now());
      return true;
    }
    writer.move_to(device_.position());
    MotionText text;
    const auto refusal = writer.line(
        {.origin = origin_, .to = position_of(end, writer.rules()), .feed = move.probe.feed}, text);
    move.is_returning = true;
    if (!refusal && !text.lines.empty()) {
      for (const std::string& line : text.lines) device_.send(line, true, {});
      device_.await_execution();
      return false;
    }
  }
  writer.move_to(end);
  expected_ = end;
  if (!check_position(end)) return device_.fault().has_value();
  interpreter::Probe probe = move.probe;
  interpreter::Position at = probe.to;
  const ToolLengths lengths = queue_.front().lengths;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (const auto axis = static_cast<interpreter::Axis>(i); at.has(axis))
      at.set_raw(axis, end[i] - (i < lengths.size() ? lengths[i] : 0));
  probe.result = interpreter::ProbeResult{tripped, at};
  (void)finish_front(lock);
  lock.unlock();
  sink_.on_probed(probe);
  lock.lock();
  return true;
}

}  // namespace dripline::machine::streamed
