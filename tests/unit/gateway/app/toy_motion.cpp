#include "tests/unit/gateway/app/toy_motion.hpp"

#include <string>
#include <utility>

namespace dripline::gateway {

using interpreter::Axis;
using machine::MachineState;

Result<void> ToyMotion::check_begin(const interpreter::Position& at) const {
  if (at.raw(Axis::X) == status_.position.raw(Axis::X)) return {};
  return fail(Errc::Conflict, "X is at {} mm, the setup begins at {} mm",
              status_.position.raw(Axis::X), at.raw(Axis::X));
}

namespace {

/// Of a machine that cuts no threads.
class ToyCheck final : public machine::MotionCheck, private interpreter::EventSink {
 public:
  interpreter::EventSink& events() override { return *this; }
  const std::optional<interpreter::Diagnostic>& refusal() const override { return refusal_; }

 private:
  void on_thread(const interpreter::Thread& thread) override {
    if (!refusal_)
      refusal_ = {
          .id = "MCH0008", .text = "this machine cannot cut threads", .line = thread.origin.line};
  }
  std::optional<interpreter::Diagnostic> refusal_;
};

}  // namespace

std::unique_ptr<machine::MotionCheck> ToyMotion::make_check(const interpreter::Position&) const {
  return checks_ ? std::make_unique<ToyCheck>() : nullptr;
}

void ToyMotion::begin(const interpreter::Position&) {
  queue_.clear();
  status_.state = MachineState::Idle;
  status_.executed = 0;
  is_held_ = is_silent_ = false;
}

machine::Seconds ToyMotion::poll(machine::Seconds, std::size_t max_actions) {
  for (; max_actions > 0 && !queue_.empty() && !is_held_; --max_actions) {
    const auto action = std::move(queue_.front());
    queue_.pop_front();
    action();
  }
  return machine::Seconds{0};
}

void ToyMotion::abort() {
  queue_.clear();
  status_.state = MachineState::Aborted;
  is_silent_ = true;
  sink_.on_aborted();
}

MachineState ToyMotion::state() const {
  if (is_held_) return MachineState::Held;
  return queue_.empty() ? status_.state : MachineState::Running;
}

machine::MachineStatus ToyMotion::status() const {
  machine::MachineStatus status = status_;
  status.state = state();
  status.queued = queue_.size();
  return status;
}

void ToyMotion::queue(std::function<void()> action) {
  if (!is_silent_) queue_.push_back(std::move(action));
}

void ToyMotion::on_line(const interpreter::Line& line) {
  queue([this, line] {
    status_.origin = line.origin;
    status_.position.set(Axis::X, line.to.linear(Axis::X));
  });
}

void ToyMotion::on_output(const interpreter::Output& output) {
  queue([this, origin = output.origin, device = output.device, text = std::string(output.text)] {
    sink_.on_output({origin, device, text});
  });
}

void ToyMotion::on_alarm(const interpreter::Alarm& alarm) {
  queue([this, alarm] {
    status_.state = MachineState::Alarmed;
    sink_.on_alarm(alarm);
  });
  is_silent_ = true;
}

void ToyMotion::on_end(const interpreter::End& end) {
  queue([this, end] {
    status_.state = MachineState::Completed;
    sink_.on_end(end);
  });
}

void ToyMotion::on_block_end(const interpreter::Origin& origin) {
  queue([this, origin] {
    status_.executed = origin.block;
    sink_.on_block_executed(origin);
  });
}

}  // namespace dripline::gateway
