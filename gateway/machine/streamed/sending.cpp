// What may be sent ahead of the axes.
#include <cmath>
#include <limits>

#include "gateway/machine/streamed/streamed_machine.hpp"

namespace dripline::machine::streamed {

namespace {

/// What is on record of an action before the device gets it.
GivenAction given(const Action& action) {
  GivenAction given;
  given.origin = action.origin;
  given.ends_block = action.ends_block;
  if (std::holds_alternative<BlockEnd>(action.body)) given.kind = GivenAction::Kind::BlockEnd;
  const auto* motion = std::get_if<Motion>(&action.body);
  if (motion == nullptr) return given;
  given.kind = GivenAction::Kind::Motion;
  given.from = motion->from;
  given.end = motion->end;
  given.arc = motion->arc;
  return given;
}

}  // namespace

/// What the device may get until the owner is here again: on record before it is sent, and not much
/// more, so that it is known after a kill what can have been executed.
void StreamedMachine::announce(Lock& lock) {
  constexpr double kOwnerAway = 0.5;
  const auto& ahead = device_.rules().seconds_ahead;
  const double limit = ahead ? *ahead + kOwnerAway : std::numeric_limits<double>::infinity();
  std::vector<GivenAction> actions;
  for (std::size_t i = announced_; i < queue_.size() && announced_seconds_ < limit; ++i) {
    actions.push_back(given(queue_[i]));
    announced_seconds_ += queue_[i].seconds;
  }
  if (actions.empty()) return;
  lock.unlock();
  for (const GivenAction& action : actions) sink_.on_given(action);
  lock.lock();
  announced_ += actions.size();
}

void StreamedMachine::pump(const Lock&) {
  if (!is_released_ || !may_begin()) return;
  if (!has_begun_ && !check_position(expected_)) return;
  has_begun_ = true;
  if (!device_.prepare(now())) return;
  for (; next_ < announced_; ++next_) {
    Action& action = queue_[next_];
    const bool must_wait = is_single_block_ && action.origin.block != queue_.front().origin.block;
    if (!must_wait && std::holds_alternative<BlockEnd>(action.body)) continue;
    auto* motion = std::get_if<Motion>(&action.body);
    if (must_wait || motion == nullptr) return device_.await_execution();
    const double seconds = action.seconds / static_cast<double>(motion->lines.size());
    for (; motion->sent < motion->lines.size(); ++motion->sent) {
      const std::string& line = motion->lines[motion->sent];
      if (!may_be_ahead(seconds) || !device_.may_send(line.size())) return;
      motion->last_serial = device_.send(line, !line.starts_with("G4"), {});
      ahead_.push_back({motion->last_serial, seconds});
      seconds_ahead_ += seconds;
    }
    expected_ = motion->end;
  }
}

/// Two lines at least are in progress, so that the axes pass from one to the next.
bool StreamedMachine::may_be_ahead(double seconds) {
  constexpr std::size_t kLeastLines = 2;
  for (; !ahead_.empty() && ahead_.front().serial <= device_.executed(); ahead_.pop_front())
    seconds_ahead_ -= ahead_.front().seconds;
  if (ahead_.empty()) seconds_ahead_ = 0;
  const auto& limit = device_.rules().seconds_ahead;
  return !limit || ahead_.size() < kLeastLines || seconds_ahead_ + seconds <= *limit;
}

/// With nothing in motion the axes must be where the program has sent them.
bool StreamedMachine::check_position(const Coordinates& expected, std::string_view reason) {
  if (!device_.is_at_rest()) return false;
  const TextRules& rules = device_.rules();
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    if (!rules.has(i)) continue;
    const double is_at = device_.position()[i];
    if (std::fabs(is_at - expected[i]) <= rules.axes[i]->tolerance) continue;
    device_.raise(
        "MCH0009",
        fmt::format("{} is at {:.3f}, the program has it at {:.3f}{}", letter_of(i), is_at,
                    expected[i],
                    reason.empty() ? ": the machine does not do what it was sent" : reason),
        now());
    return false;
  }
  return true;
}

}  // namespace dripline::machine::streamed
