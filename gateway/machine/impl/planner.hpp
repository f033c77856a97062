#pragma once

#include "gateway/machine/impl/action_queue.hpp"

namespace dripline::machine::impl {

/// Look-ahead: the highest speed at the end of each queued move from which everything after it can
/// still be obeyed (corners, slower moves, standstills, the end of what is queued).
///
/// One pass from the back of a window to the front. An exit speed that a corner or feed decides,
/// and not the window's end, is final: more moves cannot change it. So a move is planned a few
/// times at most, for any length of the queue, and the result does not depend on when it was
/// planned.
class Planner {
 public:
  /// The front of the queue is about to start, or moves already: corrects its exit speed.
  void ensure(ActionQueue& queue, const OperatorPanel& panel);
  /// Overrides or switches have changed.
  void invalidate() { final_until_ = 0, planned_next_ = 0; }

  static constexpr std::size_t kWindow = 1024;

 private:
  void plan(ActionQueue& queue, const OperatorPanel& panel);

  std::uint64_t final_until_ = 0;    ///< exits of actions before this number are final
  std::uint64_t planned_until_ = 0;  ///< the window's end
  std::uint64_t planned_next_ = 0;   ///< the queue's next() then
};

}  // namespace dripline::machine::impl
