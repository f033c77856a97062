#include "tests/support/line/line_simulator.hpp"

#include <algorithm>

namespace dripline::test_support {
namespace {

using wire::LineFault;
using wire::LineTime;
using Kind = LineFaults::Kind;

constexpr std::byte kDc1{0x11}, kDc3{0x13};
constexpr std::byte kSevenBits{0x7f};
constexpr std::size_t kMaxStepsAtOnce = 1000;

bool is_control_character(std::byte character) {
  return (character & kSevenBits) < std::byte{0x20};
}

std::size_t other(std::size_t end) {
  return 1 - end;
}

}  // namespace

std::uint64_t FaultDice::next() {  // splitmix64
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

Result<void> LineEnd::send(std::string text, LineTime now, std::string_view name) {
  if (const auto begun = line->begin_send(name, now); !begun) return fail(begun.error());
  to_send = std::move(text);
  offered = 0;
  is_all_offered = false;
  return {};
}

LineSimulator::LineSimulator(Parts parts)
    : settings_(parts.settings),
      character_time_(wire::character_time(parts.settings)),
      faults_(std::move(parts.faults)),
      dice_(parts.seed) {
  ends_[0].line = std::move(parts.host);
  ends_[1].line = std::move(parts.control);
  join_lines();
}

std::optional<LineTime> LineSimulator::next_time() const {
  std::optional<LineTime> next;
  const auto consider = [&](LineTime time) { next = next ? std::min(*next, time) : time; };
  for (std::size_t i = 0; i < 2; ++i) {
    if (wires_[i].held > 0) consider(wires_[i].leaves_at);
    if (!wires_[i].arrivals.empty()) consider(wires_[i].arrivals.front().time);
    if (const auto deadline = ends_[i].line->deadline()) consider(*deadline);
    if (held_until_[i]) consider(*held_until_[i]);
  }
  return next ? std::max(*next, now_) : next;
}

bool LineSimulator::is_quiet() const {
  const auto is_idle = [](const LineEnd& end) {
    return end.line->state().phase == wire::Phase::Idle;
  };
  return wires_[0].held + wires_[1].held == 0 && wires_[0].arrivals.empty() &&
         wires_[1].arrivals.empty() && is_idle(ends_[0]) && is_idle(ends_[1]);
}

LineSimulator::Outcome LineSimulator::run(LineTime limit) {
  poke();
  std::size_t steps_at_once = 0;
  while (!is_quiet()) {
    const auto next = next_time();
    if (!next) return Outcome::Waiting;
    if (*next > limit) return Outcome::Limit;
    steps_at_once = *next == now_ ? steps_at_once + 1 : 0;
    if (steps_at_once > kMaxStepsAtOnce) return Outcome::Busy;
    step(*next);
  }
  return Outcome::Idle;
}

void LineSimulator::run_until(LineTime time) {
  poke();
  for (auto next = next_time(); next && *next <= time; next = next_time()) step(*next);
  now_ = time;
}

void LineSimulator::poke() {
  serve(0);
  serve(1);
  pump();
}

void LineSimulator::step(LineTime time) {
  now_ = time;
  for (std::size_t i = 0; i < 2; ++i) {
    if (wires_[i].held > 0 && wires_[i].leaves_at <= now_) leave(i);
    arrive(i);
    if (held_until_[i] && *held_until_[i] <= now_) {
      held_until_[i].reset();
      ends_[i].line->set_ready(true, now_);
    }
    if (const auto deadline = ends_[i].line->deadline(); deadline && *deadline <= now_) {
      ends_[i].line->tick(now_);
    }
    serve(i);
  }
  pump();
}

/// The driver's first character is on the line and meets its fate.
void LineSimulator::leave(std::size_t from) {
  Wire& wire = wires_[from];
  const std::byte character = wire.driver[0];
  wire.driver[0] = wire.driver[1];
  if (--wire.held > 0) wire.leaves_at = now_ + character_time_;
  ++wire.counts.characters;
  if (is_stopped_[from] && !is_control_character(character)) {
    wire.counts.left_after_stop = std::max(wire.counts.left_after_stop, ++wire.left_since_stop);
  }

  Fate fate{character, std::nullopt};
  if (faults_.rate > 0 && dice_.fraction() < faults_.rate) meet_fault(wire, fate);
  if (fate.fault) ++wire.counts.reported;
  for (std::size_t i = 0; i < fate.copies; ++i) {
    wire.arrivals.push_back({std::max(now_, wire.delayed_until), fate.character, fate.fault});
  }
}

void LineSimulator::meet_fault(Wire& wire, Fate& fate) {
  ++wire.counts.faults;
  switch (faults_.kinds[dice_.below(faults_.kinds.size())]) {
    case Kind::Drop:
      fate.copies = 0;
      break;
    case Kind::Double:
      fate.copies = 2;
      break;
    case Kind::Flip:
      fate.character ^= static_cast<std::byte>(1U << dice_.below(settings_.data_bits));
      if (settings_.parity == wire::Parity::Even || settings_.parity == wire::Parity::Odd) {
        fate.fault = LineFault::Parity;
      } else if (settings_.code != wire::CharacterCode::Iso) {
        ++wire.counts.silent;  // ISO's own parity shows it
      }
      break;
    case Kind::Delay:
      wire.delayed_until =
          now_ + LineTime(static_cast<std::int64_t>(
                     dice_.fraction() * static_cast<double>(faults_.longest_delay.count())));
      break;
    case Kind::Break:
      fate.fault = LineFault::Break;
      break;
    case Kind::Parity:
      fate.fault = LineFault::Parity;
      break;
    case Kind::StuckXoff:
      if (wire::is_held_by_cts(settings_)) {
        wire.is_cts_stuck = true;
      } else {
        wire.arrivals.push_back(
            {std::max(now_, wire.delayed_until), stop_character(), std::nullopt});
      }
      break;
  }
  if (fate.copies != 1) ++wire.counts.silent;
}

void LineSimulator::arrive(std::size_t from) {
  Wire& wire = wires_[from];
  while (!wire.arrivals.empty() && wire.arrivals.front().time <= now_) {
    const Arrival arrival = wire.arrivals.front();
    wire.arrivals.pop_front();
    deliver(other(from), arrival);
    if (keeps_traffic_) {
      wire.counts.seen += arrival.fault ? '\xff' : static_cast<char>(arrival.character);
    }
  }
}

void LineSimulator::deliver(std::size_t to, const Arrival& arrival) {
  if (arrival.fault) {
    ends_[to].line->fault(*arrival.fault, now_);
  } else {
    note_stop(to, arrival.character);
    ends_[to].line->receive({&arrival.character, 1}, now_);
  }
  serve(to);
  hold_now_and_then(to);
}

/// In ISO it has a parity bit; DC1 needs none.
std::byte LineSimulator::stop_character() const {
  return settings_.code == wire::CharacterCode::Iso ? std::byte{0x93} : kDc3;
}

/// `end` hears `character`: from DC3 on nothing more may leave it.
void LineSimulator::note_stop(std::size_t end, std::byte character) {
  if (settings_.flow != wire::Flow::XonXoff && settings_.flow != wire::Flow::DcCodes) return;
  if (settings_.code == wire::CharacterCode::Ascii) character &= kSevenBits;
  const std::byte dc3 = stop_character();
  if (character != kDc1 && character != dc3) return;
  is_stopped_[end] = character == dc3;
  wires_[end].left_since_stop = wires_[end].given_since_stop = 0;
}

/// Null-modem: RTS is the other's CTS, DTR its DSR and DCD.
void LineSimulator::join_lines() {
  for (std::size_t i = 0; i < 2; ++i) {
    const wire::OutputLines out = ends_[other(i)].line->output_lines();
    const wire::InputLines in{out.rts && !wires_[i].is_cts_stuck, out.dtr, out.dtr};
    if (in == inputs_[i]) continue;
    inputs_[i] = in;
    if (wire::is_held_by_cts(settings_)) {
      is_stopped_[i] = !in.cts;
      wires_[i].left_since_stop = wires_[i].given_since_stop = 0;
    }
    ends_[i].line->lines(in, now_);
    serve(i);
  }
}

void LineSimulator::pump() {
  join_lines();
  for (std::size_t i = 0; i < 2; ++i) {
    transmit(i);
    serve(i);
  }
  join_lines();
}

void LineSimulator::transmit(std::size_t from) {
  Wire& wire = wires_[from];
  while (wire.held < wire.driver.size()) {
    const std::size_t count =
        ends_[from].line->transmit(std::span(wire.driver).subspan(wire.held), now_);
    if (count == 0) return;
    if (wire.held == 0) wire.leaves_at = now_ + character_time_;
    for (std::size_t i = 0; i < count; ++i) {
      if (is_stopped_[from] && !is_control_character(wire.driver[wire.held + i])) {
        wire.counts.given_after_stop =
            std::max(wire.counts.given_after_stop, ++wire.given_since_stop);
      }
    }
    wire.held += count;
    serve(from);
  }
}

/// The owner of `end`: takes its events, then offers what it has.
void LineSimulator::serve(std::size_t end) {
  for (;;) {
    std::vector<wire::Event> events = ends_[end].line->take_events();
    for (const wire::Event& event : events) handle(ends_[end], event);
    if (!offer(ends_[end]) && events.empty()) return;
  }
}

bool LineSimulator::offer(LineEnd& end) {
  if (end.is_all_offered || end.line->state().phase != wire::Phase::Sending) return false;
  const std::size_t rest = end.to_send.size() - end.offered;
  const std::size_t count = std::min({rest, end.offer_at_most, end.line->room()});
  if (count == 0 && rest > 0) return false;
  const std::string_view piece = std::string_view(end.to_send).substr(end.offered, count);
  const auto offered = end.line->offer(piece, count == rest, now_);
  if (!offered) {  // the transfer may have failed before; the event says so
    end.is_all_offered = true;
    return true;
  }
  end.offered += count;
  end.is_all_offered = count == rest;
  return true;
}

void LineSimulator::handle(LineEnd& end, const wire::Event& event) {
  if (const auto* text = std::get_if<wire::TextReceived>(&event)) {
    end.received += text->text;
  } else if (const auto* began = std::get_if<wire::TransferBegan>(&event)) {
    if (began->is_receiving) end.received.clear();
  } else if (const auto* ended = std::get_if<wire::TransferEnded>(&event)) {
    ++(ended->is_receiving ? end.receptions : end.sends);
  } else if (const auto* accepted = std::get_if<wire::TextAccepted>(&event)) {
    end.accepted = accepted->bytes;
  } else if (const auto* failed = std::get_if<wire::TransferFailed>(&event)) {
    end.failures.push_back(failed->error);
  } else if (const auto* fault = std::get_if<wire::LineError>(&event)) {
    end.faults.push_back(fault->error);
  } else if (const auto* request = std::get_if<wire::TransferRequest>(&event)) {
    end.requests.push_back(*request);
  }
  if (end.on_event) end.on_event(end, event, now_);
}

void LineSimulator::hold_now_and_then(std::size_t end) {
  if (ends_[end].hold_rate <= 0 || held_until_[end]) return;
  if (dice_.fraction() >= ends_[end].hold_rate) return;
  held_until_[end] = now_ + ends_[end].hold_time;
  ends_[end].line->set_ready(false, now_);
  serve(end);
}

}  // namespace dripline::test_support
