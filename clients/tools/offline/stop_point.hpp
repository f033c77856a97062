#pragma once

#include <cstdint>
#include <optional>

#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter {

/// Where an offline run may end early: after the first block of the started program that has this
/// number, or that begins in this line.
struct StopPoint {
  std::optional<std::int64_t> sequence;
  std::optional<std::uint64_t> line;

  bool is_at(const Origin& origin) const {
    if (origin.program != kMainProgram) return false;
    return sequence ? origin.sequence == *sequence : line && origin.line == *line;
  }
};

/// Delivers events to a sink up to the end of the block at a stop point, and nothing after it: an
/// interpreter that looks ahead is then further on. The sink must outlive it.
class StopGate final : public EventGate {
 public:
  StopGate(EventSink& sink, StopPoint stop) : EventGate(sink), stop_(stop) {}

  bool has_stopped() const { return has_stopped_; }

  void on_block_end(const Origin& event) override {
    EventGate::on_block_end(event);
    has_stopped_ |= stop_.is_at(event);
  }

 private:
  bool is_open() const override { return !has_stopped_; }

  StopPoint stop_;
  bool has_stopped_ = false;
};

}  // namespace dripline::interpreter
