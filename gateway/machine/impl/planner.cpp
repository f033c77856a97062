#include "gateway/machine/impl/executor.hpp"

#include <algorithm>

namespace dripline::machine::impl {

void Planner::ensure(ActionQueue& queue, const OperatorPanel& panel) {
  if (queue.first() < final_until_) return;
  const bool all_was_seen = planned_until_ == planned_next_ && queue.next() == planned_next_;
  if (all_was_seen && queue.first() < planned_until_) return;
  plan(queue, panel);
}

void Planner::plan(ActionQueue& queue, const OperatorPanel& panel) {
  const std::size_t window = std::min(queue.size(), kWindow);
  double allowed = 0;  // speed squared at the end of the action being looked at
  planned_until_ = queue.first() + window;
  planned_next_ = queue.next();
  final_until_ = queue.first();
  bool hangs_on_end = true;
  const auto decided_before = [&](std::size_t index) {
    if (hangs_on_end) final_until_ = queue.first() + index;
    hangs_on_end = false;
  };
  for (std::size_t i = window; i-- > 0;) {
    Action& action = queue.at(i);
    const OperatorPanel seen = action.lock.seen(panel);
    if (seen.single_block && action.ends_block) {
      allowed = 0;
      decided_before(i + 1);
    }
    if (auto* move = std::get_if<Move>(&action.body)) {
      const double wanted = move->wanted_speed(seen);
      const double wanted_square = wanted * wanted;
      if (allowed >= wanted_square) decided_before(i + 1);
      move->exit_square = std::min(allowed, wanted_square);
      const double reach = move->exit_square + 2 * move->acceleration * move->path.length;
      const double entry = std::min(move->corner_square, wanted_square);
      if (reach >= entry) decided_before(i);
      allowed = std::min(entry, reach);
    } else if (action.needs_standstill()) {
      allowed = 0;
      decided_before(i);
    }
  }
  // The window is too short to stop in: its first half is accurate enough, and always safe.
  if (window == kWindow) final_until_ = std::max(final_until_, queue.first() + kWindow / 2);
}

}  // namespace dripline::machine::impl
