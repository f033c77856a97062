#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "protocol/serial/line_driver.hpp"

namespace dripline::gateway {

/// What a test sees of a simulated line, and has of it in its hands.
struct SimulatedWire {
  std::string sent;          ///< all characters that have left
  wire::LineTime now{};      ///< since the line was opened
  wire::LineTime last{};     ///< when the last character left
  wire::LineTime longest{};  ///< the longest pause between two of them
  bool is_open = true;
};

/// A line whose time a test moves: characters leave at the line's rate, none sooner.
class SimulatedLine final : public serial::LineDriver {
 public:
  SimulatedLine(Parts parts, SimulatedWire& seen)
      : parts_(std::move(parts)),
        wire_(seen),
        discipline_(wire::make_discipline(parts_.settings, parts_.role).value()) {}

  void post(std::function<void(wire::Discipline&, wire::LineTime)> work) override {
    posted_.push_back(std::move(work));
  }
  void stop() override {}
  wire::LineState state() const override { return discipline_->state(); }
  bool is_open() const override { return wire_.is_open; }

  void receive(std::string_view text) {
    tell(serial::LineTraffic::What::Received, text);
    discipline_->receive(std::as_bytes(std::span(text)), wire_.now);
    take_events();
  }
  void move(wire::LineTime step) {
    if (!std::exchange(is_told_, true)) parts_.listener.on_channel(nullptr);
    wire_.now += step;
    credit_ +=
        wire::characters_per_second(parts_.settings) * std::chrono::duration<double>(step).count();
    do_posted();
    if (const auto deadline = discipline_->deadline(); deadline && *deadline <= wire_.now)
      discipline_->tick(wire_.now);
    while (credit_ >= 1 && transmit() > 0) {
    }
    credit_ = std::min(credit_, 1.0);  // a pause is not made up for
    take_events();
    do_posted();
  }

 private:
  std::size_t transmit() {
    std::array<std::byte, 64> room;
    const auto allowed = std::min(room.size(), static_cast<std::size_t>(credit_));
    const std::size_t count = discipline_->transmit(std::span(room).first(allowed), wire_.now);
    if (count > 0) {
      const std::string_view text(reinterpret_cast<const char*>(room.data()), count);
      if (!wire_.sent.empty()) wire_.longest = std::max(wire_.longest, wire_.now - wire_.last);
      wire_.last = wire_.now;
      wire_.sent += text;
      credit_ -= static_cast<double>(count);
      tell(serial::LineTraffic::What::Sent, text);
    }
    if (discipline_->state().phase == wire::Phase::Sending) parts_.listener.on_room();
    do_posted();
    return count;
  }
  void do_posted() {
    while (!posted_.empty()) {
      const auto work = std::move(posted_.front());
      posted_.pop_front();
      work(*discipline_, wire_.now);
    }
  }
  void take_events() {
    for (wire::Event& event : discipline_->take_events()) parts_.listener.on_event(event);
  }
  void tell(serial::LineTraffic::What what, std::string_view text) {
    parts_.listener.on_traffic({what, wire_.now, std::as_bytes(std::span(text)), {}});
  }

  Parts parts_;
  SimulatedWire& wire_;
  std::unique_ptr<wire::Discipline> discipline_;
  std::deque<std::function<void(wire::Discipline&, wire::LineTime)>> posted_;
  double credit_ = 0;  ///< characters that the line has had time for
  bool is_told_ = false;
};

}  // namespace dripline::gateway
